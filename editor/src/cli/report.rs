//! The one place that tells a person what went wrong.

use std::io::{self, Write};
use std::process::ExitCode;

use lightbench::assets::files::Files;
use lightbench::render::{Place, Problem, Problems};

/// A mistake in how the command was typed; the exit status is then 2.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct Usage(pub String);

/// The command was stopped by its user; the exit status is then 130, as shells have it.
#[derive(Debug, thiserror::Error)]
#[error("stopped")]
pub struct Stopped;

/// The command has said itself what is wrong; only the exit status is left.
#[derive(Debug, thiserror::Error)]
#[error("failed")]
pub struct Said;

/// Writes a line to the standard output.
///
/// # Errors
/// A reader that went away, as `head` does; [`finish`] takes that for the end.
pub fn say(line: impl AsRef<str>) -> anyhow::Result<()> {
    let mut output = io::stdout().lock();
    writeln!(output, "{}", line.as_ref())?;
    Ok(())
}

/// Writes a warning. A person who can't read it can't be told so either.
pub fn warn(warning: impl AsRef<str>) {
    let _ = writeln!(io::stderr(), "warning: {}", warning.as_ref());
}

/// Writes a note, such as what a script printed.
pub fn note(note: impl AsRef<str>) {
    let _ = writeln!(io::stderr(), "{}", note.as_ref());
}

/// Says what went wrong, if anything did, and turns it into an exit status.
pub fn finish(result: anyhow::Result<()>) -> ExitCode {
    let Err(error) = result else {
        return ExitCode::SUCCESS;
    };
    let broken_pipe = |cause: &(dyn std::error::Error + 'static)| {
        let cause = cause.downcast_ref::<io::Error>();
        cause.is_some_and(|cause| cause.kind() == io::ErrorKind::BrokenPipe)
    };
    if error.chain().any(broken_pipe) {
        return ExitCode::SUCCESS;
    }
    if error.is::<Said>() {
        return ExitCode::FAILURE;
    }
    let _ = writeln!(io::stderr(), "{}", describe(&error));
    if error.is::<Usage>() {
        ExitCode::from(2)
    } else if error.is::<Stopped>() {
        ExitCode::from(130)
    } else {
        ExitCode::FAILURE
    }
}

/// An error in words: each problem of a file on its own, other errors with their causes.
pub fn describe(error: &anyhow::Error) -> String {
    if let Some(Problems(problems)) = error.downcast_ref::<Problems>() {
        let lines: Vec<String> = problems.iter().map(|p| format!("error: {p}")).collect();
        return lines.join("\n");
    }
    if error.is::<Stopped>() {
        return error.to_string();
    }
    let mut text = format!("error: {error}");
    for cause in error.chain().skip(1).map(ToString::to_string) {
        // Many messages repeat their cause already.
        if !text.contains(&cause) {
            text.push_str(": ");
            text.push_str(&cause);
        }
    }
    text
}

/// Problems with the names of their files as the user knows them.
pub fn problems(files: &Files, problems: impl Into<Problems>) -> anyhow::Error {
    let Problems(mut problems) = problems.into();
    for problem in &mut problems {
        problem.place = known(files, &problem.place);
    }
    Problems(problems).into()
}

/// One problem, as a warning or as a note prints it.
pub fn problem(files: &Files, mut problem: Problem) -> Problem {
    problem.place = known(files, &problem.place);
    problem
}

/// A place with the name of its file as the user knows it.
pub fn known(files: &Files, place: &Place) -> Place {
    Place::new(files.display(&place.file), place.line, place.column)
}

#[cfg(test)]
mod tests {
    use super::*;
    use anyhow::Context as _;

    #[test]
    fn causes_are_said_once() {
        let cause = io::Error::other("the disk is full");
        let error = anyhow::Error::new(cause).context("can't write x.png");
        assert_eq!(
            describe(&error),
            "error: can't write x.png: the disk is full"
        );
        let error = Err::<(), _>(io::Error::other("full"))
            .context("can't write x.png: full")
            .map_err(|error| describe(&error));
        assert_eq!(error, Err("error: can't write x.png: full".to_owned()));
    }

    #[test]
    fn every_problem_has_its_own_line() {
        let problem = |line| Problem::new(Place::new("a.rhai", line, 0), "wrong");
        let error = problems(&Files::shipped(), Problems(vec![problem(1), problem(2)]));
        assert_eq!(
            describe(&error),
            "error: a.rhai:1: wrong\nerror: a.rhai:2: wrong"
        );
    }
}
