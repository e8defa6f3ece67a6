//! A project folder in which one shipped file at a time is edited, and what comes of each edit.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use lightbench::assets::files::Files;
use lightbench::render::{Compiler, Gpu, Pipeline, PipelineDesc, Problem, Renderer, guard};
use lightbench::script::{Settings, list_pipelines, load_pipeline};
use lightbench_tests::{Numbers, gpu};
use tempfile::TempDir;

use lightbench_tests::mutation::mutate;

/// Longer than loading and compiling any edit may take.
const PATIENCE: Duration = Duration::from_secs(30);
/// How long the device may take to be idle again.
const IDLE_SECONDS: u64 = 20;

/// An edit: everything about it follows from its seed.
pub struct Edit {
    pub seed: u64,
    /// The file that is edited.
    pub file: String,
    /// What it holds then.
    pub text: String,
    /// The pipeline that is loaded.
    pub pipeline: String,
    /// Values for its parameters.
    pub settings: Settings,
}

/// What came of an edit.
pub enum Outcome {
    /// It works.
    Accepted(Box<Pipeline>),
    /// It is refused.
    Refused,
}

pub struct Bench {
    folder: TempDir,
    files: Files,
    /// Paths and texts of the pipelines' files and of the shaders.
    shipped: Vec<(String, String)>,
    /// The shipped pipelines, by name.
    pipelines: Vec<(String, PipelineDesc)>,
    compiler: Compiler,
    gpu: Gpu,
}

impl Bench {
    pub fn new() -> Self {
        let gpu = gpu(false);
        Self::on(&Renderer::new(gpu))
    }

    /// A bench that compiles for a renderer.
    pub fn on(renderer: &Renderer) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let files = Files::with_project(folder.path()).unwrap();
        let pipelines: Vec<_> = list_pipelines(&files)
            .unwrap()
            .into_iter()
            .map(|entry| {
                let desc = load_pipeline(&files, &entry.name, &Settings::new());
                (
                    entry.name,
                    desc.unwrap_or_else(|problems| panic!("{problems}")),
                )
            })
            .collect();
        let mut shipped = Vec::new();
        for (folder, extension) in [("scripts/pipelines", "rhai"), ("shaders", "wgsl")] {
            for entry in files.list(folder, extension).unwrap() {
                // What looks into targets belongs to no pipeline.
                let looks = ["shaders/inspect/", "shaders/count_texels.wgsl"];
                if !looks.iter().any(|path| entry.path.starts_with(path)) {
                    shipped.push((entry.path.clone(), files.read_text(&entry.path).unwrap()));
                }
            }
        }
        Self {
            folder,
            files,
            shipped,
            pipelines,
            compiler: renderer.compiler(),
            gpu: renderer.gpu().clone(),
        }
    }

    /// The edit of a seed.
    pub fn edit(&self, seed: u64) -> Edit {
        let mut numbers = Numbers(seed);
        let (file, text) = &self.shipped[numbers.below(self.shipped.len())];
        let others: Vec<String> = self.shipped.iter().map(|(_, text)| text.clone()).collect();
        let text = mutate(text, &others, &mut numbers);
        let users = self.users(file);
        let (pipeline, desc) = users[numbers.below(users.len())];
        let mut settings = Settings::new();
        // Parameters choose other passes and other variants of shaders.
        for parameter in &desc.parameters {
            use lightbench::render::description::ParameterKind;
            let value = match &parameter.kind {
                ParameterKind::Switch => ["on", "off"][numbers.below(2)].to_owned(),
                ParameterKind::Choice { options } => options[numbers.below(options.len())].clone(),
                ParameterKind::Number { .. } => continue,
            };
            if numbers.below(3) == 0 {
                settings.set(parameter.name.as_str(), value);
            }
        }
        // Some values exclude each other even where nothing is edited.
        if load_pipeline(&self.files, pipeline, &settings).is_err() {
            settings = Settings::new();
        }
        Edit {
            seed,
            file: file.clone(),
            text,
            pipeline: pipeline.clone(),
            settings,
        }
    }

    /// The pipelines that an edit of a file can touch.
    fn users(&self, file: &str) -> Vec<&(String, PipelineDesc)> {
        let uses = |(name, desc): &&(String, PipelineDesc)| {
            file == format!("scripts/pipelines/{name}.rhai")
                || desc.passes.iter().any(|pass| {
                    pass.shader
                        .as_ref()
                        .is_some_and(|shader| shader.path == file)
                })
        };
        let found: Vec<_> = self.pipelines.iter().filter(uses).collect();
        // Parts, modules and shared stages belong to many.
        if found.is_empty() {
            self.pipelines.iter().collect()
        } else {
            found
        }
    }

    fn path(&self, edit: &Edit) -> PathBuf {
        self.folder.path().join(&edit.file)
    }

    /// Saves an edit, compiles the pipeline, and takes the edit back.
    ///
    /// # Errors
    /// Whatever must never happen: a panic, a mistake without a place, a refusal of the device, too
    /// long a time.
    pub fn outcome(&mut self, edit: &Edit) -> Result<Outcome, String> {
        let path = self.path(edit);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, &edit.text).unwrap();
        self.compiler.forget(&edit.file);
        let began = Instant::now();
        let result = guard::catch(|| {
            let desc = load_pipeline(&self.files, &edit.pipeline, &edit.settings)?;
            self.compiler.compile(&self.files, &desc)
        });
        let took = began.elapsed();
        let checked = match result {
            Err(panic) => Err(format!("it panics: {panic}")),
            Ok(Ok(pipeline)) => Ok(Outcome::Accepted(Box::new(pipeline))),
            Ok(Err(problems)) => match problems.0.iter().find_map(|p| self.complaint(p)) {
                Some(complaint) => Err(complaint),
                None => Ok(Outcome::Refused),
            },
        };
        std::fs::remove_file(&path).unwrap();
        self.compiler.forget(&edit.file);
        // What nobody uses any more is given back only when the device is asked how it is.
        self.gpu
            .wait(IDLE_SECONDS)
            .map_err(|error| error.to_string())?;
        if took > PATIENCE {
            return Err(format!("it takes {took:?}"));
        }
        checked
    }

    /// What is wrong with the report of a problem.
    fn complaint(&self, problem: &Problem) -> Option<String> {
        let told = problem.to_string();
        let place = &problem.place;
        if place.file.is_empty() {
            return Some(format!("no file is named: {told}"));
        }
        let text = self.files.read_text(&place.file).unwrap_or_default();
        if place.line == 0 && !text.trim().is_empty() {
            return Some(format!("no line is named: {told}"));
        }
        let lines = text
            .replace("\r\n", "\n")
            .replace('\r', "\n")
            .split('\n')
            .count();
        if place.line as usize > lines {
            return Some(format!("the file has {lines} lines: {told}"));
        }
        // Words of the libraries, and of refusals that nobody foresaw.
        let words = [
            "naga",
            "wgpu",
            "Some(",
            "None",
            "Scalar",
            "TypeInner",
            "Handle",
            "unwrap",
            "panicked",
            "can't tell why",
            "AbstractFloat",
            "AbstractInt",
        ];
        let said = format!(
            "{} {}",
            problem.message,
            problem.hint.as_deref().unwrap_or("")
        );
        let quoted = |word: &&&str| text.contains(**word);
        let word = words.iter().find(|word| said.contains(**word));
        word.filter(|word| !quoted(word))
            .map(|word| format!("`{word}` is said: {told}"))
    }

    /// An edit in words, for failures.
    pub fn describe(&self, edit: &Edit) -> String {
        let before = self.shipped.iter().find(|(path, _)| *path == edit.file);
        let before: Vec<&str> = before.map_or("", |(_, text)| text).split('\n').collect();
        let after: Vec<&str> = edit.text.split('\n').collect();
        let same = |(a, b): &(&&str, &&str)| a == b;
        let head = before.iter().zip(&after).take_while(same).count();
        let tail = before
            .iter()
            .rev()
            .zip(after.iter().rev())
            .take_while(same)
            .count();
        let tail = tail.min(before.len().min(after.len()) - head);
        let part = |lines: &[&str], sign: char| -> String {
            let shown = &lines[head..lines.len() - tail];
            shown
                .iter()
                .take(8)
                .map(|line| format!("  {sign} {line}\n"))
                .collect()
        };
        format!(
            "seed {}: {} from line {}, through `{}` {:?}\n{}{}",
            edit.seed,
            edit.file,
            head + 1,
            edit.pipeline,
            edit.settings.iter().collect::<Vec<_>>(),
            part(&before, '-'),
            part(&after, '+')
        )
    }
}
