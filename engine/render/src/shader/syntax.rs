//! What the reader of WGSL complains about: words that it does not know, signs that are missing,
//! values of the wrong type.

use naga::front::wgsl::ParseError;

use super::conversion::how_to_convert;
use super::declarations::Listings;
use super::explain::File;
use super::tokens::{Token, tokens};
use super::{short_types, undecorate};
use crate::problem::{Place, Problem, suggestion};

/// Names that every shader knows, for suggestions.
const BUILT_IN: [&str; 92] = [
    "abs",
    "acos",
    "all",
    "any",
    "array",
    "arrayLength",
    "asin",
    "atan",
    "atan2",
    "atomicAdd",
    "atomicAnd",
    "atomicLoad",
    "atomicMax",
    "atomicMin",
    "atomicOr",
    "atomicStore",
    "bitcast",
    "bool",
    "ceil",
    "clamp",
    "cos",
    "cosh",
    "countOneBits",
    "cross",
    "degrees",
    "determinant",
    "discard",
    "distance",
    "dot",
    "dpdx",
    "dpdy",
    "exp",
    "exp2",
    "f32",
    "faceForward",
    "false",
    "firstLeadingBit",
    "firstTrailingBit",
    "floor",
    "fma",
    "fract",
    "fwidth",
    "i32",
    "inverseSqrt",
    "ldexp",
    "length",
    "log",
    "log2",
    "mat2x2f",
    "mat3x3f",
    "mat4x4f",
    "max",
    "min",
    "mix",
    "modf",
    "normalize",
    "pack2x16float",
    "pow",
    "radians",
    "reflect",
    "refract",
    "round",
    "saturate",
    "select",
    "sign",
    "sin",
    "sinh",
    "smoothstep",
    "sqrt",
    "step",
    "tan",
    "tanh",
    "textureDimensions",
    "textureLoad",
    "textureNumLevels",
    "textureSample",
    "textureSampleCompare",
    "textureSampleGrad",
    "textureSampleLevel",
    "textureStore",
    "transpose",
    "true",
    "trunc",
    "u32",
    "vec2f",
    "vec2i",
    "vec2u",
    "vec3f",
    "vec3i",
    "vec3u",
    "vec4f",
    "vec4u",
];

/// Explains an error of the reader.
pub(super) fn explain(error: &ParseError, file: &File) -> Problem {
    let labels: Vec<(std::ops::Range<usize>, String)> = error
        .labels()
        .filter_map(|(span, text)| Some((span.to_range()?, plain(text))))
        .collect();
    let place_of = |index: usize| {
        let (span, _) = labels.get(index)?;
        file.composed_place(span.start)
    };
    let place = place_of(0).or_else(|| place_of(1));
    let place = place.unwrap_or_else(|| Place::file(file.path));
    let message = plain(error.message());
    let label = labels.first().map(|(_, text)| text.as_str());
    let quoted = labels.first().and_then(|(span, _)| file.quoted(span));
    let quoted = quoted.map(undecorate).unwrap_or_default();

    let problem = |message: String| Problem::new(place.clone(), message);
    if let Some(name) = between(&message, "no definition in scope for identifier: `", "`") {
        return unknown_name(name, place, file);
    }
    if let Some(expected) = message.strip_prefix("expected ")
        && let Some((expected, found)) = expected.rsplit_once(", found \"")
    {
        return unexpected(expected, found.trim_end_matches('"'), place, file);
    }
    if let Some((from, to)) = two(&message, "automatic conversions cannot convert ", " to ") {
        // The second label is the value, the first what wants it.
        let place = place_of(1).unwrap_or(place);
        let problem = Problem::new(place, format!("this is {from}, but {to} is needed here"));
        return with_conversion(problem, from, to);
    }
    if let Some((from, to)) = two(&message, "the type of ", " is expected to be ")
        && let Some((to, value)) = to.split_once(", but got ")
    {
        let message = format!("{from} is declared as {to}, but its value is {value}");
        return with_conversion(problem(message), value, to);
    }
    if let Some(name) = between(&message, "invalid field accessor `", "`") {
        let names: Vec<String> = file.listings.all().flat_map(Listings::names).collect();
        // Short names are components, and near to everything.
        let near = names
            .iter()
            .map(String::as_str)
            .filter(|n| *n != name && name.len() > 3);
        let near = suggestion(name, near);
        return problem(format!("there is no `.{name}` here"))
            .with_hint(near.unwrap_or_else(|| {
            "a structure has its members, a vector `.x`, `.y`, `.z`, `.w` or `.r`, `.g`, `.b`, `.a`"
                .to_owned()
        }));
    }
    if let Some(name) = between(&message, "name `", "` is a reserved keyword") {
        return problem(format!(
            "`{name}` is a word of the language and can't be a name"
        ))
        .with_hint("choose another name");
    }
    if let Some(name) = between(&message, "redefinition of `", "`") {
        let first = place_of(1).filter(|first| first.line > 0);
        let problem = problem(format!("there are two declarations of `{name}`"));
        return match first {
            Some(first) => problem.with_hint(format!("the first is in line {}", first.line)),
            None => problem.with_hint("give one of them another name"),
        };
    }
    if message == "invalid left-hand side of assignment" {
        let problem = problem(format!("`{quoted}` can't be assigned to"));
        let note = error.notes().last().map(plain);
        return problem.with_hint(match note {
            Some(note) if note.contains("instead of `let`") => {
                note.replace("consider declaring", "declare")
            }
            Some(_) => "assign to one component at a time, as in `color.x = 1.0;`".to_owned(),
            None => "only a `var`, or a buffer that is `read_write`, can be assigned to".to_owned(),
        });
    }
    if let Some((from, to)) = two(&message, "cannot cast a ", " to a ") {
        let message = format!("a `{from}` can't become a `{to}`");
        return with_conversion(problem(message), from, to);
    }
    if let Some((wanted, found)) = two(&message, "wrong number of arguments: expected ", ", found ")
    {
        let name: String = quoted
            .chars()
            .take_while(|&c| super::tokens::is_word(c))
            .collect();
        // Of 2..4 the last is not included.
        let wanted = match wanted.split_once("..") {
            Some((least, end)) => {
                let most = end.parse::<u32>().map_or(0, |end| end.saturating_sub(1));
                format!("{least} to {most}")
            }
            None => wanted.to_owned(),
        };
        let problem = problem(format!(
            "`{name}` takes {wanted} arguments here, not {found}"
        ));
        return match name.as_str() {
            "textureLoad" => problem.with_hint(
                "as in `textureLoad(hdr, texel, 0)`: the last is the mip level, or the sample",
            ),
            "textureSample" => problem.with_hint("as in `textureSample(hdr, linear_sampler, uv)`"),
            _ => problem,
        };
    }
    if let Some((number, name)) = two(
        message.trim_end_matches('`'),
        "inconsistent type passed as argument #",
        " to `",
    ) {
        let mut notes = error.notes().map(plain);
        let first = notes.find_map(|note| {
            let (index, ty) = two(&note, "Because argument #", " has type ")?;
            let ty = ty.split(',').next().unwrap_or(ty);
            Some(format!(
                "argument {index} is `{ty}`: give all the same type"
            ))
        });
        let mut problem = problem(format!(
            "argument {number} of `{name}` does not fit the others"
        ));
        problem.hint = first;
        return problem;
    }
    if message.starts_with("atomic variables cannot be accessed directly") {
        return problem("an atomic is read and written by functions alone".to_owned()).with_hint(
            "as in `atomicLoad(&count)`, `atomicStore(&count, 0u)` or `atomicAdd(&count, 1u)`",
        );
    }
    for (what, list) in [
        (
            "builtin",
            "position, vertex_index, instance_index, front_facing, frag_depth, \
            sample_index, global_invocation_id, local_invocation_id, local_invocation_index, \
            workgroup_id, num_workgroups",
        ),
        (
            "attribute",
            "location, builtin, interpolate, invariant, group, binding, vertex, \
            fragment, compute, workgroup_size, align, size",
        ),
        (
            "storage format",
            "rgba8unorm, rgba16float, rgba32float, r32float, r32uint, r32sint, \
            rg32float, rgba8uint, rgba16uint, rgba32uint",
        ),
        ("access", "read, write, read_write"),
        (
            "address space",
            "function, private, workgroup, uniform, storage",
        ),
    ] {
        if let Some(name) = between(&message, &format!("unknown {what}: `"), "`") {
            let hint = suggestion(name, list.split(',').map(str::trim))
                .unwrap_or_else(|| format!("there are {list}"));
            return problem(format!("there is no {what} `{name}`")).with_hint(hint);
        }
    }
    let notes: Vec<String> = error.notes().map(plain).collect();
    let problem = problem(message.clone());
    // The library's authors speak to each other there.
    let useful = |text: &&str| {
        !text.is_empty() && !message.contains(*text) && !text.contains("://") && *text != "see msg"
    };
    let hint = notes
        .iter()
        .map(String::as_str)
        .find(useful)
        .or(label.filter(useful));
    match hint {
        Some(hint) => problem.with_hint(hint),
        None => problem,
    }
}

/// A name that nothing declares.
fn unknown_name(name: &str, place: Place, file: &File) -> Problem {
    let listing = file
        .listings
        .of_path(file.path)
        .unwrap_or(file.listings.shader());
    // A name of a module: what stands before it says of which.
    let line = listing
        .active
        .lines()
        .nth(place.line.saturating_sub(1) as usize);
    let before = line
        .unwrap_or("")
        .chars()
        .take(place.column.saturating_sub(1) as usize);
    let before: String = before.collect();
    if let Some(before) = before.strip_suffix("::") {
        let alias = before
            .rsplit(|c| !super::tokens::is_word(c))
            .next()
            .unwrap_or_default();
        let import = listing.imports.iter().find(|import| import.alias == alias);
        let module = import.map_or(alias, |import| import.path.as_str());
        let names = file
            .listings
            .of_module(module)
            .map(Listings::public_names)
            .unwrap_or_default();
        let problem = Problem::new(place, format!("`{module}` has no `{name}`"));
        return match suggestion(name, names.iter().map(String::as_str)) {
            Some(hint) => problem.with_hint(hint),
            None => problem.with_hint(format!(
                "it has {}",
                names
                    .iter()
                    .map(|name| format!("`{name}`"))
                    .collect::<Vec<_>>()
                    .join(", ")
            )),
        };
    }
    let own = Listings::names(listing);
    let imported = listing.imports.iter().map(|import| import.alias.as_str());
    let known = own
        .iter()
        .map(String::as_str)
        .chain(imported)
        .chain(BUILT_IN);
    let problem = Problem::new(place, format!("`{name}` is not declared"));
    for (module, listing) in file.listings.modules() {
        if Listings::public_names(listing)
            .iter()
            .any(|known| known == name)
        {
            let last = module.rsplit("::").next().unwrap_or_default();
            return problem.with_hint(format!("it is `{last}::{name}`"));
        }
    }
    if let Some(hint) = suggestion(name, known.filter(|known| *known != name)) {
        return problem.with_hint(hint);
    }
    // Names of other languages that students bring along.
    let hint = match name {
        "float" | "double" => "a number with a point is `f32`",
        "int" => "a whole number is `i32`, or `u32` if it is never negative",
        "uint" => "a whole number that is never negative is `u32`",
        "vec2" | "vec3" | "vec4" | "float2" | "float3" | "float4" => {
            "a vector of numbers is `vec2f`, `vec3f` or `vec4f`"
        }
        "lerp" => "it is called `mix` here",
        "frac" => "it is called `fract` here",
        "rsqrt" | "inversesqrt" => "it is called `inverseSqrt` here",
        "texture" | "tex2D" | "texture2D" => "it is called `textureSample` here",
        "ddx" | "dFdx" => "it is called `dpdx` here",
        "mod" | "fmod" => "the remainder is written `a % b`",
        "gl_FragCoord" => "it is the argument `@builtin(position) pixel: vec4f`",
        _ => "declare it with `let`, or import the module that has it",
    };
    problem.with_hint(hint)
}

/// A word or sign in the place of another.
fn unexpected(expected: &str, found: &str, place: Place, file: &File) -> Problem {
    let found = undecorate(found);
    let expected = match expected {
        "identifier" => "a name".to_owned(),
        "expression" | "number" => "a value".to_owned(),
        "assignment or increment/decrement" => "`=` or a call".to_owned(),
        "->" | "@" => format!("`{expected}`"),
        "statement" => "a statement".to_owned(),
        word if word.starts_with("global item") => {
            "a declaration: `fn`, `struct`, `var`, `const`".to_owned()
        }
        word if word.starts_with("LHS expression") => "the name of a variable".to_owned(),
        word if word.starts_with("switch item") => "`case`, `default` or `}`".to_owned(),
        word if word.starts_with("for loop") => "a step of the loop, as in `i++`".to_owned(),
        word if word.starts_with("workgroup size") => "`,` or `)`".to_owned(),
        word if word.starts_with("next argument") => "`,` or `;`".to_owned(),
        // "operation (`+`)" and the like.
        word => match word
            .split_once(" (`")
            .and_then(|(_, rest)| rest.strip_suffix("`)"))
        {
            Some(sign) => format!("`{sign}`"),
            None => word.to_owned(),
        },
    };
    let listing = file.listings.of_path(file.path);
    let text = listing.map_or("", |listing| listing.active.as_str());
    let lines: Vec<&str> = text.lines().collect();
    if found.is_empty() {
        // The end of the file is the end of its last word.
        let last = lines
            .iter()
            .rposition(|line| !line.trim().is_empty())
            .unwrap_or(0);
        let column = lines
            .get(last)
            .map_or(0, |line| line.trim_end().chars().count());
        let place = Place::new(file.path, last as u32 + 1, column as u32 + 1);
        return Problem::new(place, format!("the file ends where {expected} is expected"))
            .with_hint("is a `}` missing, or the rest of the file?");
    }
    let above = lines.get(..place.line.saturating_sub(1) as usize);
    let line = lines.get(place.line.saturating_sub(1) as usize);
    let problem = Problem::new(
        place.clone(),
        format!("{expected} is expected, not `{found}`"),
    );
    let (Some(above), Some(line)) = (above, line) else {
        return problem;
    };
    // A sign that is missing at the end of a line is missed at the next word.
    let before: String = line
        .chars()
        .take(place.column.saturating_sub(1) as usize)
        .collect();
    let last = above.iter().rposition(|line| !line.trim().is_empty());
    let word = |text: &str| !text.is_empty() && text.chars().all(super::tokens::is_word);
    match (last, found.as_str()) {
        (Some(last), _)
            if before.trim().is_empty()
                && (expected.contains("`;`") || expected == "`=` or a call") =>
        {
            problem.with_hint(format!("is a `;` missing at the end of line {}?", last + 1))
        }
        (_, "?") => {
            problem.with_hint("a value is chosen by `select(if_false, if_true, condition)`")
        }
        (_, "=") => problem.with_hint("to compare, write `==`"),
        (_, found) if expected == "`=` or a call" && word(before.trim()) && word(found) => problem
            .with_hint(format!(
                "a variable is declared `let {found} = …;`, or `var {found} = …;` if it changes"
            )),
        _ if expected == "`)`" => match open_before(text, &place) {
            Some(open) if open.line == place.line => {
                problem.with_hint(format!("the `(` in column {} is still open", open.column))
            }
            Some(open) => problem.with_hint(format!("the `(` in line {} is still open", open.line)),
            None => problem,
        },
        _ => problem,
    }
}

/// The last parenthesis before a place that nothing has closed by then.
fn open_before<'a>(text: &'a str, place: &Place) -> Option<Token<'a>> {
    let mut open = Vec::new();
    for token in tokens(text) {
        if (token.line, token.column) >= (place.line, place.column) {
            break;
        }
        match token.text {
            "(" => open.push(token),
            ")" => drop(open.pop()),
            _ => {}
        }
    }
    open.pop()
}

/// Adds how a value of one type becomes one of another.
fn with_conversion(mut problem: Problem, from: &str, to: &str) -> Problem {
    problem.hint = how_to_convert(from, to);
    problem
}

/// A message of the library in the project's words.
fn plain(text: impl AsRef<str>) -> String {
    short_types(&undecorate(text.as_ref()))
        .replace("`{AbstractFloat}`", "a number with a point")
        .replace("`{AbstractInt}`", "a whole number")
}

/// What stands between two texts, where the message is that and nothing else.
fn between<'a>(message: &'a str, before: &str, after: &str) -> Option<&'a str> {
    let rest = message.strip_prefix(before)?;
    rest.strip_suffix(after)
}

fn two<'a>(message: &'a str, before: &str, middle: &str) -> Option<(&'a str, &'a str)> {
    message.strip_prefix(before)?.split_once(middle)
}
