//! How a value of one type becomes one of another, told to people.

use super::short_types;

/// The way from a value of a type to another type, both as WGSL writes them. `None` where there is
/// none: structures, arrays, textures.
pub fn how_to_convert(from: &str, to: &str) -> Option<String> {
    let short = |name: &str| short_types(name.trim_matches('`'));
    let to = short(to);
    let (from, wanted) = (Shape::of(&short(from))?, Shape::of(&to)?);
    Some(match (from.size, wanted.size) {
        (1, 1) if from.kind == 'f' && wanted.kind != 'f' => {
            format!("write it without a point, or round it: `{to}(round(x))`")
        }
        (1, 1) => format!("convert it: `{to}(x)`"),
        (1, _) => format!("`{to}(x)` has this number in every component"),
        (_, 1) => "take one component, as in `v.x`".to_owned(),
        (a, b) if a < b => format!("add what is missing, as in `{to}(v, 1.0)`"),
        (a, b) if a > b => {
            let letters = if b == 2 { "xy" } else { "xyz" };
            format!("take a part of it, as in `v.{letters}`")
        }
        _ => format!("convert it: `{to}(v)`"),
    })
}

/// A number or a vector of numbers.
struct Shape {
    /// How many numbers: 1 to 4.
    size: u32,
    /// `f`, `i` or `u` as at the end of `vec3f`, or `b` for `bool`.
    kind: char,
}

impl Shape {
    fn of(name: &str) -> Option<Self> {
        let (size, kind) = match name {
            "f32" | "f16" => (1, 'f'),
            "i32" => (1, 'i'),
            "u32" => (1, 'u'),
            "bool" => (1, 'b'),
            number if number.ends_with("number with a point") => (1, 'f'),
            number if number.ends_with("whole number") => (1, 'i'),
            vector => {
                let mut letters = vector.strip_prefix("vec")?.chars();
                let size = letters.next()?.to_digit(10)?;
                let kind = match letters.as_str() {
                    "h" => 'f',
                    "<bool>" => 'b',
                    letters => letters.chars().next().filter(|c| "fiu".contains(*c))?,
                };
                (size, kind)
            }
        };
        Some(Self { size, kind })
    }
}

#[cfg(test)]
mod tests {
    use super::how_to_convert;

    #[test]
    fn each_pair_has_its_way() {
        for (from, to, expected) in [
            ("vec3<f32>", "f32", "take one component, as in `v.x`"),
            ("`vec4f`", "`vec3f`", "take a part of it, as in `v.xyz`"),
            ("vec3f", "vec2f", "take a part of it, as in `v.xy`"),
            (
                "vec3f",
                "vec4f",
                "add what is missing, as in `vec4f(v, 1.0)`",
            ),
            ("vec3u", "vec3<f32>", "convert it: `vec3f(v)`"),
            (
                "f32",
                "vec3f",
                "`vec3f(x)` has this number in every component",
            ),
            ("u32", "f32", "convert it: `f32(x)`"),
            (
                "a number with a point",
                "u32",
                "write it without a point, or round it: `u32(round(x))`",
            ),
            ("bool", "u32", "convert it: `u32(x)`"),
        ] {
            assert_eq!(
                how_to_convert(from, to).as_deref(),
                Some(expected),
                "{from} {to}"
            );
        }
        for (from, to) in [
            ("Surface", "vec3f"),
            ("vec3f", "array<f32, 4>"),
            ("vecmat", "f32"),
        ] {
            assert_eq!(how_to_convert(from, to), None, "{from} {to}");
        }
    }
}
