//! The `pipeline(…)` object, which gathers what a file declares and what is wrong with it.

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lightbench_render::description::{Ability, Named, Parameter, PassDesc};
use lightbench_render::heat_map::{self, HeatMap};
use lightbench_render::problem::suggestion;
use lightbench_render::{PipelineDesc, Place, Problem, Problems};
use rhai::Dynamic;

use super::{buffers, parameters, passes, targets};
use crate::api::{Api, Arguments, Mistake, ScriptType};
use crate::compile::Compiler;
use crate::names::list;
use crate::settings::Settings;

/// One pipeline while its file runs.
///
/// Mistakes are noted and the file goes on, so that a student sees all of them at once.
#[derive(Debug)]
pub(super) struct Builder {
    pub(super) desc: PipelineDesc,
    pub(super) problems: Vec<Problem>,
    /// One for each pass of the description.
    handles: Vec<Handle>,
    next_id: usize,
    /// Before which pass new ones come; after all without one.
    pub(super) insert_before: Option<usize>,
    pub(super) settings: Settings,
}

/// What a script's variable of a pass stands for; passes may move, their numbers stay.
#[derive(Debug)]
struct Handle {
    id: usize,
    last: Last,
}

/// What `.clear`, `.blend`, `.mip` and the like apply to: what the pass named last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Last {
    Nothing,
    Read,
    Update,
    Color,
    Depth,
}

/// A pipeline, as scripts hold it.
#[derive(Clone, Debug)]
pub(super) struct Pipeline(Arc<Mutex<Builder>>);

impl ScriptType for Pipeline {
    const NAME: &'static str = "pipeline";
}

impl Pipeline {
    pub(super) fn lock(&self) -> MutexGuard<'_, Builder> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Does something to the builder; a mistake is noted at the place of the call.
    pub(super) fn note(
        &self,
        arguments: &Arguments,
        work: impl FnOnce(&mut Builder, Place) -> Result<(), Mistake>,
    ) {
        let at = arguments.place();
        let mut builder = self.lock();
        if let Err(mistake) = work(&mut builder, at.clone()) {
            builder.problems.push(problem(at, mistake));
        }
    }
}

/// The pipelines that a file makes: usually one.
#[derive(Clone, Debug)]
pub(super) struct Pipelines {
    path: String,
    settings: Settings,
    made: Arc<Mutex<Vec<Pipeline>>>,
}

impl Pipelines {
    pub(super) fn new(path: &str, settings: &Settings) -> Self {
        Self {
            path: path.to_owned(),
            settings: settings.clone(),
            made: Arc::default(),
        }
    }

    fn made(&self) -> MutexGuard<'_, Vec<Pipeline>> {
        self.made.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Begins anew, for another run.
    pub(super) fn forget(&self) {
        self.made().clear();
    }

    fn begin(&self, title: String, at: &Place) -> Pipeline {
        let stem = self.path.rsplit('/').next().unwrap_or_default();
        let desc = PipelineDesc {
            name: stem.trim_end_matches(".rhai").to_owned(),
            file: Place::new(self.path.as_str(), at.line, at.column),
            title,
            ..PipelineDesc::default()
        };
        let pipeline = Pipeline(Arc::new(Mutex::new(Builder {
            desc,
            problems: Vec::new(),
            handles: Vec::new(),
            next_id: 0,
            insert_before: None,
            settings: self.settings.clone(),
        })));
        self.made().push(pipeline.clone());
        pipeline
    }

    /// Goes on with the pipeline that an imported file made.
    fn derive(&self, title: String) -> Result<Pipeline, Mistake> {
        let made = self.made();
        let Some(pipeline) = made.last() else {
            return Err(Mistake::new("no imported file made a pipeline").with_hint(
                "write `import \"deferred_shading\" as base;` with a pipeline's name before it",
            ));
        };
        pipeline.lock().desc.title = title;
        Ok(pipeline.clone())
    }

    /// What the file made, or everything that is wrong with it.
    pub(super) fn finish(
        &self,
        result: Result<Dynamic, Problem>,
        compiler: &Compiler,
    ) -> Result<PipelineDesc, Problems> {
        let value = result.as_ref().ok().cloned();
        let chosen = value.and_then(|value| value.try_cast::<Pipeline>());
        let pipeline = chosen.or_else(|| self.made().last().cloned());
        let mut problems = Vec::new();
        let mut desc = None;
        if let Some(pipeline) = pipeline {
            let mut builder = pipeline.lock();
            problems.append(&mut builder.problems);
            if result.is_ok() {
                problems.extend(builder.unknown_settings());
                problems.extend(builder.add_heat_map());
            }
            desc = Some(PipelineDesc {
                scripts: compiler.sources.paths(),
                ..builder.desc.clone()
            });
        } else if result.is_ok() {
            let text = compiler.sources.text(&self.path);
            let place = match text.filter(|text| !text.trim().is_empty()) {
                Some(_) => Place::new(self.path.as_str(), 1, 1),
                None => Place::file(self.path.as_str()),
            };
            problems.push(
                Problem::new(place, "the file makes no pipeline")
                    .with_hint("begin with `let p = pipeline(\"Title\");`"),
            );
        }
        problems.extend(result.err());
        let explainer = compiler.explainer();
        // A mistake in a loop is one mistake.
        let mut seen = BTreeSet::new();
        problems.retain(|p| seen.insert((p.place.to_string(), p.message.clone())));
        let problems: Vec<Problem> = problems
            .into_iter()
            .map(|problem| explainer.with_source(problem))
            .collect();
        match desc {
            Some(desc) if problems.is_empty() => Ok(desc),
            _ => Err(Problems(problems)),
        }
    }
}

impl Builder {
    /// Adds a pass where new ones go, and gives its number.
    pub(super) fn add_pass(&mut self, pass: PassDesc) -> usize {
        let before = self
            .insert_before
            .and_then(|id| self.handles.iter().position(|handle| handle.id == id));
        let index = before.unwrap_or(self.handles.len());
        let id = self.next_id;
        self.next_id += 1;
        let last = Last::Nothing;
        self.handles.insert(index, Handle { id, last });
        self.desc.passes.insert(index, pass);
        id
    }

    /// The pass of a number, and what it named last.
    pub(super) fn pass(&mut self, id: usize) -> Option<(&mut PassDesc, &mut Last)> {
        let index = self.handles.iter().position(|handle| handle.id == id)?;
        Some((
            self.desc.passes.get_mut(index)?,
            &mut self.handles.get_mut(index)?.last,
        ))
    }

    /// The number of the pass of that name.
    pub(super) fn find_pass(&self, name: &str) -> Result<usize, Mistake> {
        let names = || self.desc.passes.iter().map(|pass| pass.name.as_str());
        let index = names().position(|known| known == name);
        index
            .and_then(|index| self.handles.get(index))
            .map(|handle| handle.id)
            .ok_or_else(|| {
                let mistake = Mistake::new(format!("there is no pass `{name}`"));
                let all = list(names(), "and");
                let hint = suggestion(name, names()).unwrap_or_else(|| match all.as_str() {
                    "" => "there is none yet".to_owned(),
                    all => format!("there are {all}"),
                });
                mistake.with_hint(hint)
            })
    }

    /// Takes a pass out.
    pub(super) fn remove_pass(&mut self, id: usize) {
        if let Some(index) = self.handles.iter().position(|handle| handle.id == id) {
            self.handles.remove(index);
            self.desc.passes.remove(index);
        }
    }

    /// Adds the parameters of the heat map, which every pipeline has, and changes the pipeline where
    /// one is asked for.
    fn add_heat_map(&mut self) -> Vec<Problem> {
        let at = self.desc.file.clone();
        let mut problems = Vec::new();
        let mut add = |desc: &mut PipelineDesc, mut parameter: Parameter| {
            if let Some(own) = desc.parameter(&parameter.name) {
                problems.push(
                    Problem::new(
                        own.at.clone(),
                        format!("every pipeline has a parameter `{}` already", own.name),
                    )
                    .with_hint("choose another name"),
                );
                return;
            }
            match self.settings.get(&parameter.name).map(ToString::to_string) {
                None => {}
                Some(text) => match parameter.parse(&text) {
                    Ok(value) => parameter.value = value,
                    Err(message) => problems.push(Problem::new(at.clone(), message)),
                },
            }
            desc.parameters.push(parameter);
        };
        add(&mut self.desc, HeatMap::parameter(at.clone()));
        add(&mut self.desc, HeatMap::most_parameter(at.clone()));
        if let Some(map) = HeatMap::of(&self.desc) {
            problems.extend(map.apply(&mut self.desc).err());
        }
        problems
    }

    /// Settings that no parameter has taken.
    fn unknown_settings(&self) -> Vec<Problem> {
        let names = || self.desc.parameters.iter().map(|p| p.name.as_str());
        let mut problems = Vec::new();
        for (name, _) in self.settings.iter() {
            if names().any(|known| known == name)
                || [heat_map::PARAMETER, heat_map::MOST].contains(&name)
            {
                continue;
            }
            let mut problem = Problem::new(
                self.desc.file.clone(),
                format!(
                    "the pipeline `{}` has no parameter `{name}`",
                    self.desc.name
                ),
            );
            problem.hint = Some(match suggestion(name, names()) {
                Some(hint) => hint,
                None if self.desc.parameters.is_empty() => "it has no parameters".to_owned(),
                None => format!("it has {}", list(names(), "and")),
            });
            problems.push(problem);
        }
        problems
    }
}

pub(super) fn problem(at: Place, mistake: Mistake) -> Problem {
    let mut problem = Problem::new(at, mistake.message);
    problem.hint = mistake.hint;
    problem
}

/// Targets and buffers share their names, since shaders use them in one place.
pub(super) fn not_taken(builder: &Builder, name: &str) -> Result<(), Mistake> {
    let target = builder
        .desc
        .target(name)
        .map(|target| ("target", &target.at));
    let buffer = builder
        .desc
        .buffer(name)
        .map(|buffer| ("buffer", &buffer.at));
    match target.or(buffer) {
        Some((what, first)) => Err(Mistake::new(format!(
            "there is a {what} `{name}` already, in line {} of {}",
            first.line, first.file
        ))
        .with_hint("give one of them another name")),
        None => Ok(()),
    }
}

/// A name that a shader uses must be one that WGSL accepts.
pub(super) fn shader_name(name: &str, what: &str) -> Result<(), Mistake> {
    let letters = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let good = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && name.chars().all(letters)
        && !name.starts_with("__")
        && name != "_";
    if good {
        return Ok(());
    }
    Err(
        Mistake::new(format!("`{name}` can't be the name of {what}"))
            .with_hint("shaders use the name: letters a to z, digits and `_`, no digit first"),
    )
}

/// Registers everything that a pipeline file can call.
pub(super) fn register(api: &mut Api, made: &Pipelines) {
    api.object::<Pipeline>();
    api.section("Pipelines");
    let (made, imported) = (made.clone(), made.clone());
    api.function(
        "pipeline(title)",
        "Begins a pipeline. The title is for people: on the command line the pipeline has the name \
         of its file. The file's last line gives the pipeline back.",
        move |arguments| {
            let title = arguments.text(0)?;
            Ok(made.begin(title, &arguments.place()))
        },
    );
    for (form, supported, about) in [
        (
            "supports(ability, text)",
            true,
            "Says that the pipeline can do something, as `transparency` or `msaa`, and how. With \
             `brdf_ggx` and its like it says which reflection models it draws; others give way to the \
             nearest of these. Any other name will do; reports list them.",
        ),
        (
            "lacks(ability, reason)",
            false,
            "Says that the pipeline can't do something, and why.",
        ),
    ] {
        method(api, form, about, move |builder, arguments, at| {
            let ability = Ability {
                name: arguments.text(0)?,
                at,
                supported,
                text: arguments.text(1)?,
            };
            // What a derived pipeline says takes the place of what the first one said.
            builder
                .desc
                .abilities
                .retain(|other| other.name != ability.name);
            builder.desc.abilities.push(ability);
            Ok(())
        });
    }
    method(
        api,
        "describe(text)",
        "Says in a sentence or two what the pipeline trades and when to choose it.",
        |builder, arguments, _| {
            builder.desc.description = arguments.text(0)?;
            Ok(())
        },
    );
    method(
        api,
        "hdr(target)",
        "Names the target that holds linear light, before exposure and tone curve: EXR files are \
         made from it, and comparisons measure it. Without it the pipeline makes no EXR files.",
        |builder, arguments, at| {
            let name = arguments.text(0)?;
            builder.desc.hdr = Some(Named { name, at });
            Ok(())
        },
    );
    method(
        api,
        "show(target)",
        "Names the target that the viewport and picture files show. Every pipeline has one.",
        |builder, arguments, at| {
            let name = arguments.text(0)?;
            builder.desc.output = Some(Named { name, at });
            Ok(())
        },
    );
    parameters::register(api);
    targets::register(api);
    buffers::register(api);
    passes::register(api);
    api.section("Changing another pipeline");
    api.function(
        "derive(title)",
        "Goes on with the pipeline of the file that was imported last: change its passes with \
         `.pass`, take some out, insert others.",
        move |arguments| imported.derive(arguments.text(0)?),
    );
}

/// Registers a method of the pipeline that gives the pipeline back.
pub(super) fn method(
    api: &mut Api,
    form: &str,
    about: &'static str,
    body: impl Fn(&mut Builder, &Arguments, Place) -> Result<(), Mistake> + Send + Sync + 'static,
) {
    api.method(form, about, move |pipeline: Pipeline, arguments| {
        pipeline.note(arguments, |builder, at| body(builder, arguments, at));
        Ok(pipeline)
    });
}
