//! `--set`: whose parameter gets which value.

use lightbench::render::PipelineDesc;
use lightbench::render::problem::suggestion;
use lightbench::script::Settings;

use super::report::Usage;

/// To whom a value is given.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Owner {
    /// Nobody said.
    Unsaid,
    /// `scene.NAME`.
    Scene,
    /// `pipeline.NAME`: every pipeline of the command.
    Pipelines,
    /// `deferred_shading.NAME`.
    Pipeline(String),
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Value {
    owner: Owner,
    name: String,
    text: String,
}

/// The values of a command line.
#[derive(Clone, Debug, Default)]
pub struct Given(Vec<Value>);

impl Given {
    /// Reads `NAME=VALUE`, `scene.NAME=VALUE`, `pipeline.NAME=VALUE` and, with a pipeline's name
    /// before the dot, values for that one alone.
    ///
    /// # Errors
    /// Text of another form, or something before the dot that is none of these.
    pub fn read(texts: &[String], pipelines: &[&str]) -> Result<Self, Usage> {
        let values = texts.iter().map(|text| read(text, pipelines));
        values.collect::<Result<_, _>>().map(Self)
    }

    /// The values for one pipeline, given the description that it has without any.
    ///
    /// A name without an owner goes to the pipelines that have such a parameter.
    pub fn for_pipeline(&self, desc: &PipelineDesc) -> Settings {
        let mut settings = Settings::new();
        for value in &self.0 {
            let meant = match &value.owner {
                Owner::Unsaid => desc.parameter(&value.name).is_some(),
                Owner::Pipelines => true,
                Owner::Pipeline(name) => *name == desc.name,
                Owner::Scene => false,
            };
            if meant {
                settings.set(value.name.as_str(), value.text.as_str());
            }
        }
        settings
    }

    /// The values for the scene: its own, and those of which no pipeline has the name.
    pub fn for_scene(&self, pipelines: &[PipelineDesc]) -> Settings {
        let mut settings = Settings::new();
        for value in &self.0 {
            let meant = match value.owner {
                Owner::Scene => true,
                Owner::Unsaid => !has_parameter(pipelines, &value.name),
                Owner::Pipelines | Owner::Pipeline(_) => false,
            };
            if meant {
                settings.set(value.name.as_str(), value.text.as_str());
            }
        }
        settings
    }

    /// Refuses a name without an owner that the scene has too.
    ///
    /// # Errors
    /// A sentence with the two ways to write it.
    pub fn check_owners<'a>(
        &self,
        pipelines: &[PipelineDesc],
        scene: impl IntoIterator<Item = &'a str> + Clone,
    ) -> Result<(), Usage> {
        let both = self.0.iter().find(|value| {
            value.owner == Owner::Unsaid
                && has_parameter(pipelines, &value.name)
                && scene.clone().into_iter().any(|name| name == value.name)
        });
        match both {
            None => Ok(()),
            Some(Value { name, text, .. }) => Err(Usage(format!(
                "both the scene and the pipeline have a parameter `{name}`: write \
                 `--set scene.{name}={text}` or `--set pipeline.{name}={text}`"
            ))),
        }
    }

    /// What a misspelt name without an owner may have meant among the pipelines' parameters.
    pub fn near_misses(&self, pipelines: &[PipelineDesc]) -> Vec<String> {
        let names = || pipelines.iter().flat_map(|desc| &desc.parameters);
        let unsaid = self
            .0
            .iter()
            .filter(|value| value.owner == Owner::Unsaid && !has_parameter(pipelines, &value.name));
        unsaid
            .filter_map(|value| {
                let near = suggestion(&value.name, names().map(|p| p.name.as_str()))?;
                Some(format!(
                    "`{}` is no parameter of the pipeline either; {near}",
                    value.name
                ))
            })
            .collect()
    }
}

fn has_parameter(pipelines: &[PipelineDesc], name: &str) -> bool {
    pipelines.iter().any(|desc| desc.parameter(name).is_some())
}

fn read(text: &str, pipelines: &[&str]) -> Result<Value, Usage> {
    let form = || {
        Usage(format!(
            "--set {text}: a value is written NAME=VALUE, as in lights=256 or pipeline.exposure=1"
        ))
    };
    let (name, value) = text.split_once('=').ok_or_else(form)?;
    let (owner, name) = match name.trim().rsplit_once('.') {
        None => (Owner::Unsaid, name.trim()),
        Some(("scene", name)) => (Owner::Scene, name),
        Some(("pipeline", name)) => (Owner::Pipelines, name),
        Some((owner, name)) if pipelines.contains(&owner) => {
            (Owner::Pipeline(owner.to_owned()), name)
        }
        Some((owner, _)) => {
            let known = || {
                ["scene", "pipeline"]
                    .into_iter()
                    .chain(pipelines.iter().copied())
            };
            let hint = suggestion(owner, known()).unwrap_or_else(|| {
                let known: Vec<String> = known().map(|name| format!("`{name}`")).collect();
                format!("before the dot stands one of {}", known.join(", "))
            });
            return Err(Usage(format!(
                "--set {text}: there is no `{owner}`; {hint}"
            )));
        }
    };
    if name.is_empty() {
        return Err(form());
    }
    Ok(Value {
        owner,
        name: name.to_owned(),
        text: value.trim().to_owned(),
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use lightbench::render::Place;
    use lightbench::render::description::{Parameter, ParameterKind, ParameterValue};

    fn pipeline(name: &str, parameters: &[&str]) -> PipelineDesc {
        let parameter = |name: &&str| Parameter {
            name: (*name).to_owned(),
            at: Place::default(),
            description: String::new(),
            unit: String::new(),
            kind: ParameterKind::Switch,
            default: ParameterValue::Switch(false),
            value: ParameterValue::Switch(false),
            tunable: false,
        };
        PipelineDesc {
            name: name.to_owned(),
            parameters: parameters.iter().map(parameter).collect(),
            ..PipelineDesc::default()
        }
    }

    fn shown(settings: &Settings) -> String {
        let all = settings
            .iter()
            .map(|(name, value)| format!("{name}={value}"));
        all.collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn values_go_to_their_owners() {
        let pipelines = [
            pipeline("a", &["exposure", "mode"]),
            pipeline("b", &["exposure"]),
        ];
        let texts = [
            "lights=4",
            "exposure=1",
            "mode=x=y",
            "b.exposure=2",
            "scene.exposure=3",
            "pipeline.new=5",
        ]
        .map(str::to_owned);
        let given = Given::read(&texts, &["a", "b"]).unwrap();
        assert_eq!(shown(&given.for_scene(&pipelines)), "lights=4 exposure=3");
        assert_eq!(
            shown(&given.for_pipeline(&pipelines[0])),
            "exposure=1 mode=x=y new=5"
        );
        assert_eq!(
            shown(&given.for_pipeline(&pipelines[1])),
            "exposure=2 new=5"
        );
    }

    #[test]
    fn a_name_of_both_sides_needs_an_owner() {
        let pipelines = [pipeline("a", &["exposure"])];
        let read = |text: &str| Given::read(&[text.to_owned()], &["a"]).unwrap();
        let error = read("exposure=1")
            .check_owners(&pipelines, ["exposure"])
            .unwrap_err();
        assert!(error.0.contains("scene.exposure=1") && error.0.contains("pipeline.exposure=1"));
        assert!(
            read("exposure=1")
                .check_owners(&pipelines, ["lights"])
                .is_ok()
        );
        assert!(
            read("scene.exposure=1")
                .check_owners(&pipelines, ["exposure"])
                .is_ok()
        );
    }

    #[test]
    fn mistakes_are_explained() {
        let read = |text: &str| Given::read(&[text.to_owned()], &["deferred_shading"]);
        for text in ["", "lights", "=3", "scene.=3"] {
            assert!(read(text).unwrap_err().0.contains("NAME=VALUE"), "{text}");
        }
        let error = read("deferred_shadng.x=1").unwrap_err().0;
        assert!(
            error.contains("did you mean `deferred_shading`?"),
            "{error}"
        );
        let near = read("exposur=1")
            .unwrap()
            .near_misses(&[pipeline("a", &["exposure"])]);
        assert!(near[0].contains("did you mean `exposure`?"), "{near:?}");
    }
}
