//! `lightbench grade`: a folder of hand-ins, graded without anybody there.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;
use std::time::Duration;

use anyhow::{Context as _, bail};
use clap::Args;
use lightbench::assets::files::{Files, write_atomic};
use lightbench::assets::{Digest, Progress};
use lightbench::course::grading::{
    self, Assignment, Ending, GradeError, Marked, Options, Reason, Record, Told, prepared,
};
use lightbench::course::hand_in::HandedIn;
use lightbench::course::{archive, book, exports, supervise};
use lightbench::lab::lesson::{self, Lesson, STARTER, Source};
use lightbench::render::gpu::adapters;

use super::{Language, find};
use crate::cli::arguments::GpuArguments;
use crate::cli::progress::stop_on_ctrl_c;
use crate::cli::report::{Stopped, Usage, note, say, warn};

/// Arguments of `lightbench grade`.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  lightbench grade lessons/06-deferred-shading --submissions moodle --hidden hidden/06 --out grades
  lightbench grade 6 --submissions canvas --ids ids.csv --out grades
  lightbench grade 6 --submissions canvas --out grades --student 4711     grades that one again

The folder of hand-ins is what Moodle or Canvas exports, unpacked, or one with NAME.zip for each student.
Each hand-in is checked by a process of its own, on the software driver. The same command goes on where
it was stopped, and grades again what has changed. In --out come index.html, points.csv, junit.xml, and
for each student a page and a file for Gradescope.
The exit status is 0 if all were judged, 1 if not.")]
pub struct Arguments {
    /// The lesson: its number, its name, or its folder
    #[arg(value_name = "LESSON")]
    lesson: String,
    /// The folder of hand-ins
    #[arg(long, value_name = "DIR")]
    submissions: PathBuf,
    /// The folder for what comes out
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// A folder with more checks, which students do not have; without it, `hidden` of the lesson's folder
    #[arg(long, value_name = "DIR")]
    hidden: Option<PathBuf>,
    /// A table `student,id`: for whom numbers are drawn, whatever a hand-in says
    #[arg(long, value_name = "FILE")]
    ids: Option<PathBuf>,
    /// A student to grade again though nothing has changed; may be given again
    #[arg(long, value_name = "STUDENT")]
    student: Vec<String>,
    /// How many are checked at a time; without it, half of the processors
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=256))]
    jobs: Option<u32>,
    /// Seconds that a check may take
    #[arg(long, value_name = "SECONDS", default_value_t = 180, value_parser = clap::value_parser!(u64).range(1..))]
    time: u64,
    /// Mebibytes of memory that a check may take
    #[arg(long, value_name = "MIB", default_value_t = 3072, value_parser = clap::value_parser!(u64).range(64..))]
    memory: u64,
    /// The language of the pages
    #[arg(long, value_enum, default_value_t)]
    language: Language,
    #[command(flatten)]
    gpu: GpuArguments,
}

/// What a check may print, in bytes.
const MOST_OUTPUT: u64 = 1 << 20;

/// Runs the command.
///
/// # Errors
/// A lesson or folders that can't be read or written, or hand-ins that could not be judged.
pub fn run(arguments: &Arguments, files: &Files, limits: Option<&Path>) -> anyhow::Result<()> {
    let lesson = find(files, &arguments.lesson)?;
    let export = exports::read(&arguments.submissions)
        .with_context(|| format!("--submissions {}", arguments.submissions.display()))?;
    if export.submissions.is_empty() {
        bail!(
            "{} holds no hand-in: neither an export of Moodle or Canvas, unpacked, nor .zip files",
            arguments.submissions.display()
        );
    }
    for stray in &export.strays {
        warn(format!("{} is nobody's hand-in.", stray.display()));
    }
    let hidden = hidden(arguments, files, &lesson)?;
    let adapter = adapter(&arguments.gpu);
    let options = options(arguments, &lesson, hidden.as_deref(), adapter.as_deref())?;
    let known = |student: &String| export.submissions.iter().any(|s| s.student == *student);
    if let Some(unknown) = arguments.student.iter().find(|student| !known(student)) {
        return Err(Usage(format!("no hand-in is of the student `{unknown}`")).into());
    }
    let launch = Launch {
        program: std::env::current_exe().context("this program's own path is not known")?,
        project: files.project().map(Path::to_owned),
        limits: limits.map(Path::to_owned),
        lesson: arguments.lesson.clone(),
        hidden,
        adapter,
        gpu: arguments.gpu.clone(),
        time: arguments.time,
        memory: arguments.memory,
    };
    let progress = Progress::new();
    stop_on_ctrl_c(&progress);
    let records = grading::grade(
        &lesson,
        &export.submissions,
        &options,
        &|assignment| launch.command(assignment),
        &|| progress.is_cancelled(),
        &tell,
    )
    .map_err(|error| match error {
        GradeError::Cancelled => {
            note("Stopped. The same command goes on with what is missing.");
            Stopped.into()
        }
        other => anyhow::Error::from(other),
    })?;
    for line in not_enforced(&records) {
        warn(format!("This system can't enforce: {line}"));
    }
    let book = Book {
        lesson: &lesson,
        out: &arguments.out,
        records: &records,
        reasons: reasons(&lesson, &arguments.out, &records, &options.ids)?,
        language: arguments.language.into(),
    };
    book.write()?;
    let failed = records.iter().filter(|record| record.points().is_none());
    match failed.count() {
        0 => Ok(()),
        count => bail!(
            "{count} of {} hand-ins could not be judged; {} says why",
            records.len(),
            arguments.out.join("index.html").display()
        ),
    }
}

/// The folder of hidden checks: the one that is asked for, or the lesson's own.
fn hidden(
    arguments: &Arguments,
    files: &Files,
    lesson: &Lesson,
) -> anyhow::Result<Option<PathBuf>> {
    if let Some(folder) = &arguments.hidden {
        let full = fs::canonicalize(folder);
        return full
            .map(Some)
            .with_context(|| format!("--hidden {}", folder.display()));
    }
    let of_project = files
        .project()
        .map(|p| p.join(lesson::LESSONS).join(&lesson.name));
    let places = [Some(PathBuf::from(&arguments.lesson)), of_project];
    let own = places
        .into_iter()
        .flatten()
        .map(|place| place.join(lesson::HIDDEN));
    let own = own
        .filter(|folder| folder.join(lesson::CHECKS).is_file())
        .find_map(|f| fs::canonicalize(f).ok());
    if own.is_none() {
        note("No hidden checks: only those that students have are made.");
    }
    Ok(own)
}

/// The adapter that draws: a hung graphics card can't be taken from a process, a hung thread can.
fn adapter(gpu: &GpuArguments) -> Option<String> {
    if gpu.options().adapter.is_some() {
        return None;
    }
    let software = adapters().into_iter().find(|adapter| adapter.software);
    if software.is_none() {
        warn(
            "There is no software driver here. If a shader hangs the graphics card, grading ends.",
        );
    }
    software.map(|adapter| adapter.name)
}

fn options(
    arguments: &Arguments,
    lesson: &Lesson,
    hidden: Option<&Path>,
    adapter: Option<&str>,
) -> anyhow::Result<Options> {
    let mut parts = vec![
        env!("CARGO_PKG_VERSION").to_owned(),
        format!("{:?} {adapter:?}", arguments.gpu.options()),
        digest_of(&lesson.source)?,
    ];
    if let Some(hidden) = hidden {
        parts.push(digest_of(&Source::of_folder(hidden)?)?);
    }
    let half = thread::available_parallelism().map_or(1, |count| count.get().div_ceil(2));
    Ok(Options {
        out: arguments.out.clone(),
        jobs: arguments.jobs.map_or(half, |jobs| jobs as usize),
        bounds: supervise::Bounds {
            time: Duration::from_secs(arguments.time),
            memory: arguments.memory << 20,
            output: MOST_OUTPUT,
        },
        archive: archive::Bounds::default(),
        fingerprint: Digest::of(parts.join("\n").as_bytes()).to_string(),
        again: arguments.student.clone(),
        ids: arguments
            .ids
            .as_deref()
            .map(ids)
            .transpose()?
            .unwrap_or_default(),
    })
}

fn digest_of(source: &Source) -> anyhow::Result<String> {
    let mut text = String::new();
    for path in source.list_all()? {
        let digest = Digest::of(&source.read(&path)?);
        text += &format!("{path} {digest}\n");
    }
    Ok(Digest::of(text.as_bytes()).to_string())
}

/// Reads `student,id` lines.
fn ids(path: &Path) -> anyhow::Result<BTreeMap<String, String>> {
    let text = fs::read_to_string(path).with_context(|| format!("--ids {}", path.display()))?;
    let mut ids = BTreeMap::new();
    for (index, line) in text.lines().enumerate() {
        let line = line.trim().trim_start_matches('\u{feff}');
        if line.is_empty() || index == 0 && line.eq_ignore_ascii_case("student,id") {
            continue;
        }
        let Some((student, id)) = line.split_once(',') else {
            bail!(
                "{}:{}: write `student,id`, as in `4711,ana.perez`",
                path.display(),
                index + 1
            );
        };
        let unquoted = |text: &str| text.trim().trim_matches('"').to_owned();
        ids.insert(unquoted(student), unquoted(id));
    }
    Ok(ids)
}

/// How the process that checks is started.
struct Launch {
    program: PathBuf,
    project: Option<PathBuf>,
    limits: Option<PathBuf>,
    lesson: String,
    hidden: Option<PathBuf>,
    adapter: Option<String>,
    gpu: GpuArguments,
    time: u64,
    memory: u64,
}

impl Launch {
    fn command(&self, assignment: &Assignment) -> Command {
        let mut command = Command::new(&self.program);
        command.arg("grade-worker").arg(&self.lesson);
        command.arg("--work").arg(&assignment.work);
        command.arg("--out").arg(&assignment.out);
        command.args(["--time", &self.time.to_string()]);
        command.args(["--memory", &self.memory.to_string()]);
        let given = [
            ("--project", self.project.as_deref()),
            ("--limits", self.limits.as_deref()),
            ("--hidden", self.hidden.as_deref()),
        ];
        for (name, path) in given {
            if let Some(path) = path {
                command.arg(name).arg(path);
            }
        }
        if let Some(id) = &assignment.id {
            command.arg(format!("--id={id}"));
        }
        if let Some(adapter) = &self.adapter {
            command.args(["--adapter", adapter]);
        }
        command.args(self.gpu.again());
        // What it writes for itself goes into its own folder too.
        command.env("TMPDIR", &assignment.out);
        command
    }
}

fn tell(told: Told) {
    let record = &told.record;
    let what = match (&record.ending, record.points()) {
        (Ending::Checked(outcome), Some(points)) => format!("{points} of {}", outcome.of),
        _ => record
            .problem()
            .unwrap_or_default()
            .lines()
            .next()
            .unwrap_or_default()
            .to_owned(),
    };
    let known = if told.known { ", as before" } else { "" };
    note(format!(
        "[{}/{}] {}: {what}{known}",
        told.done, told.of, record.student
    ));
}

fn not_enforced(records: &[Record]) -> Vec<&str> {
    let mut lines: Vec<&str> = records
        .iter()
        .flat_map(|record| &record.not_enforced)
        .map(String::as_str)
        .collect();
    lines.sort_unstable();
    lines.dedup();
    lines
}

/// Two people may well write the same few lines. Files with fewer letters of one's own say nothing.
const LEAST_LETTERS: usize = 200;

/// How many letters a file has in lines that the starter does not have. Spaces at both ends do not count.
fn own_letters(file: &[u8], starter: &[u8]) -> usize {
    let [file, starter] = [file, starter].map(String::from_utf8_lossy);
    let known: BTreeSet<&str> = starter.lines().map(str::trim).collect();
    let own = file
        .lines()
        .map(str::trim)
        .filter(|line| !known.contains(line));
    own.map(|line| line.chars().count()).sum()
}

/// What speaks for it that hand-ins have one source.
fn reasons(
    lesson: &Lesson,
    out: &Path,
    records: &[Record],
    ids: &BTreeMap<String, String>,
) -> anyhow::Result<BTreeMap<String, Vec<Reason>>> {
    let mut all = Vec::new();
    for record in records {
        let work = prepared(&out.join("students"), &record.student).join("work");
        let mut own = Vec::new();
        for path in &lesson.about.submits {
            let starter = lesson.source.read(&format!("{STARTER}/{path}"))?;
            // What is missing is nobody's.
            if let Ok(bytes) = fs::read(work.join(path))
                && own_letters(&bytes, &starter) >= LEAST_LETTERS
            {
                own.push((path.clone(), Digest::of(&bytes).to_string()));
            }
        }
        all.push(Marked {
            student: record.student.clone(),
            says: HandedIn::of(&work).and_then(|says| says.student),
            listed: ids.get(&record.student).cloned(),
            files: own,
        });
    }
    Ok(grading::mark(&all))
}

/// All files that come out.
struct Book<'a> {
    lesson: &'a Lesson,
    out: &'a Path,
    records: &'a [Record],
    reasons: BTreeMap<String, Vec<Reason>>,
    language: lesson::Language,
}

impl Book<'_> {
    fn write(&self) -> anyhow::Result<()> {
        let title = self.lesson.about.title.in_language(self.language);
        let of = self.lesson.about.points();
        for record in self.records {
            let folder = prepared(&self.out.join("students"), &record.student);
            let page = book::Page {
                record,
                title,
                of,
                pictures: &folder.join("check/pictures"),
                language: self.language,
            };
            put(&folder.join("page.html"), &book::student_page(&page))?;
            let file = prepared(&self.out.join("gradescope"), &record.student);
            let file = PathBuf::from(format!("{}.json", file.display()));
            if let Some(result) = book::gradescope(record, self.language) {
                put(&file, &serde_json::to_string_pretty(&result)?)?;
            } else if file.exists() {
                fs::remove_file(&file).with_context(|| file.display().to_string())?;
            }
        }
        let page_of = |record: &Record| {
            let folder = prepared(Path::new("students"), &record.student);
            format!("{}/page.html", folder.display())
        };
        let index = book::overview(title, of, self.records, &self.reasons, &page_of);
        put(
            &self.out.join("junit.xml"),
            &book::junit(self.records, self.language),
        )?;
        put(
            &self.out.join("points.csv"),
            &book::csv(self.records, &self.reasons),
        )?;
        let mut starter = Vec::new();
        for path in self.lesson.source.list(STARTER)? {
            let bytes = self.lesson.source.read(&format!("{STARTER}/{path}"))?;
            starter.push((path, bytes));
        }
        book::for_jplag(self.records, self.out, &self.lesson.about.submits, &starter)?;
        let index_path = self.out.join("index.html");
        put(&index_path, &index)?;
        let look = self
            .records
            .iter()
            .filter(|record| record.needs_a_person() || self.reasons.contains_key(&record.student));
        let count = self.records.len();
        let noun = if count == 1 { "hand-in" } else { "hand-ins" };
        let look = look.count();
        note(format!("{count} {noun}; a person should look at {look}."));
        say(index_path.display().to_string())
    }
}

fn put(path: &Path, text: &str) -> anyhow::Result<()> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    }
    Ok(write_atomic(path, text.as_bytes())?)
}
