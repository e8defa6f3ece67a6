//! Parameters of a pipeline: numbers, switches and choices that are set from outside.

use lightbench_render::description::{Parameter, ParameterKind, ParameterValue};
use lightbench_render::problem::suggestion;
use lightbench_render::{Place, Problem};
use rhai::Dynamic;

use super::builder::{Builder, Pipeline, method, problem, shader_name};
use crate::api::{Api, Arguments, Mistake};

pub(super) fn register(api: &mut Api) {
    api.section("Parameters");
    api.method(
        "number(name, default, min, max)",
        "Declares a number that can be set from outside, and gives the value in force. Shaders \
         read it as `parameters.name`, an f32.",
        |pipeline: Pipeline, arguments| {
            let default = arguments.number(1);
            declare(&pipeline, arguments, |arguments| {
                let (default, min, max) = (
                    arguments.number(1)?,
                    arguments.number(2)?,
                    arguments.number(3)?,
                );
                if min > max {
                    return Err(Mistake::new(format!(
                        "the smallest value, {min}, is larger than the largest, {max}"
                    )));
                }
                if !(min..=max).contains(&default) {
                    return Err(Mistake::new(format!(
                        "the default, {default}, is not from {min} to {max}"
                    )));
                }
                Ok((
                    ParameterKind::Number { min, max },
                    ParameterValue::Number(default),
                ))
            })
            .map_or_else(|| Ok(Dynamic::from(default.unwrap_or(0.0))), Ok)
        },
    );
    api.method(
        "switch(name, default)",
        "Declares a switch that can be set from outside, and gives the value in force. Shaders \
         read it as `parameters.name`, a u32 of 0 or 1.",
        |pipeline: Pipeline, arguments| {
            let default = arguments.switch(1).unwrap_or(false);
            Ok(declare(&pipeline, arguments, |arguments| {
                Ok((
                    ParameterKind::Switch,
                    ParameterValue::Switch(arguments.switch(1)?),
                ))
            })
            .unwrap_or_else(|| Dynamic::from(default)))
        },
    );
    for form in ["choice(name, options)", "choice(name, options, default)"] {
        api.method(
            form,
            "Declares a choice that can be set from outside, and gives the name in force. The \
             default is the first option, unless one is named. Shaders read it as \
             `parameters.name`, the index as a u32.",
            |pipeline: Pipeline, arguments| {
                Ok(declare(&pipeline, arguments, choice).unwrap_or_else(|| "".into()))
            },
        );
    }
    method(
        api,
        "tunable(parameter)",
        "Says that a switch or a choice changes what the pipeline costs and not what it shows, as the side \
         of a tile does. `lightbench compare --tune` measures the pipeline with the fastest of its values.",
        |builder, arguments, _| {
            let parameter = declared(builder, &arguments.text(0)?)?;
            if matches!(parameter.kind, ParameterKind::Number { .. }) {
                let message = format!(
                    "`{}` is a number, and has too many values to try",
                    parameter.name
                );
                return Err(Mistake::new(message).with_hint("declare it with `.choice`"));
            }
            parameter.tunable = true;
            Ok(())
        },
    );
    for form in ["about(parameter, text)", "about(parameter, text, unit)"] {
        method(
            api,
            form,
            "Says what a parameter does, and its unit, as in `EV`, for the editor.",
            |builder, arguments, _| {
                let (name, text) = (arguments.text(0)?, arguments.text(1)?);
                let unit = match arguments.len() {
                    3 => arguments.text(2)?,
                    _ => String::new(),
                };
                let parameter = declared(builder, &name)?;
                parameter.description = text;
                parameter.unit = unit;
                Ok(())
            },
        );
    }
}

/// The parameter of a name that was declared before.
fn declared<'a>(builder: &'a mut Builder, name: &str) -> Result<&'a mut Parameter, Mistake> {
    let parameters = &mut builder.desc.parameters;
    let known: Vec<String> = parameters.iter().map(|p| p.name.clone()).collect();
    parameters
        .iter_mut()
        .find(|p| p.name == name)
        .ok_or_else(|| {
            let mistake = Mistake::new(format!("there is no parameter `{name}`"));
            match suggestion(name, known.iter().map(String::as_str)) {
                Some(hint) => mistake.with_hint(hint),
                None => {
                    mistake.with_hint("declare it above, with `.number`, `.switch` or `.choice`")
                }
            }
        })
}

fn choice(arguments: &Arguments) -> Result<(ParameterKind, ParameterValue), Mistake> {
    let mut options = Vec::new();
    for option in arguments.array(1)? {
        let option = option
            .into_string()
            .map_err(|_| arguments.wrong(1, "an array of texts"))?;
        if options.contains(&option) {
            return Err(Mistake::new(format!("there are two options `{option}`")));
        }
        options.push(option);
    }
    let Some(first) = options.first() else {
        return Err(Mistake::new("a choice needs at least one option"));
    };
    let default = if arguments.len() == 3 {
        let default = arguments.text(2)?;
        if !options.contains(&default) {
            let mistake = Mistake::new(format!("the default `{default}` is not among the options"));
            let known = options.iter().map(String::as_str);
            return Err(match suggestion(&default, known) {
                Some(hint) => mistake.with_hint(hint),
                None => mistake,
            });
        }
        default
    } else {
        first.clone()
    };
    Ok((
        ParameterKind::Choice { options },
        ParameterValue::Choice(default),
    ))
}

/// Declares a parameter and gives the value in force, or nothing where the call has a mistake.
fn declare(
    pipeline: &Pipeline,
    arguments: &Arguments,
    kind: impl FnOnce(&Arguments) -> Result<(ParameterKind, ParameterValue), Mistake>,
) -> Option<Dynamic> {
    let at = arguments.place();
    let mut builder = pipeline.lock();
    match parameter(&mut builder, arguments, &at, kind) {
        Ok(value) => Some(value),
        Err(mistake) => {
            builder.problems.push(problem(at, mistake));
            None
        }
    }
}

fn parameter(
    builder: &mut Builder,
    arguments: &Arguments,
    at: &Place,
    kind: impl FnOnce(&Arguments) -> Result<(ParameterKind, ParameterValue), Mistake>,
) -> Result<Dynamic, Mistake> {
    let name = arguments.text(0)?;
    shader_name(&name, "a parameter")?;
    if let Some(first) = builder.desc.parameter(&name) {
        return Err(Mistake::new(format!(
            "there is a parameter `{name}` already, in line {} of {}",
            first.at.line, first.at.file
        )));
    }
    let declared = |(kind, default): (ParameterKind, ParameterValue)| Parameter {
        name,
        at: at.clone(),
        description: String::new(),
        unit: String::new(),
        kind,
        value: default.clone(),
        tunable: false,
        default,
    };
    let mut parameter = match kind(arguments) {
        Ok(found) => declared(found),
        Err(mistake) => {
            // It is declared all the same, so that its uses are no mistakes too.
            let any = (ParameterKind::Switch, ParameterValue::Switch(false));
            builder.desc.parameters.push(declared(any));
            return Err(mistake);
        }
    };
    if let Some(setting) = builder.settings.get(&parameter.name) {
        match parameter.parse(&setting.to_string()) {
            Ok(value) => parameter.value = value,
            // The mistake is in the setting, not in the file; the place says what refuses it.
            Err(message) => builder.problems.push(Problem::new(at.clone(), message)),
        }
    }
    let value = match &parameter.value {
        ParameterValue::Number(number) => Dynamic::from(*number),
        ParameterValue::Switch(on) => Dynamic::from(*on),
        ParameterValue::Choice(name) => Dynamic::from(name.clone()),
    };
    builder.desc.parameters.push(parameter);
    Ok(value)
}
