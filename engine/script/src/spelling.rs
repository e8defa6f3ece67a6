//! Values as a script would write them.

use lightbench_world::glam::DVec3;
use rhai::Dynamic;

/// A value as a script would write it; `None` where it has no such form.
pub(crate) fn spell(value: &Dynamic) -> Option<String> {
    if let Ok(whole) = value.as_int() {
        return Some(whole.to_string());
    }
    if let Ok(number) = value.as_float() {
        return Some(spell_number(number));
    }
    if let Ok(on) = value.as_bool() {
        return Some(on.to_string());
    }
    if let Some(text) = value.read_lock::<rhai::ImmutableString>() {
        return Some(spell_text(&text));
    }
    if let Some(items) = value.read_lock::<rhai::Array>() {
        let items: Option<Vec<String>> = items.iter().map(spell).collect();
        return Some(format!("[{}]", items?.join(", ")));
    }
    if let Some(vector) = value.read_lock::<DVec3>() {
        return Some(spell_call("vec3", *vector));
    }
    let color = value.read_lock::<crate::color::Color>()?;
    Some(spell_call("rgb", color.0))
}

/// A number with as many digits as it takes to read back the same bits.
pub(crate) fn spell_number(number: f64) -> String {
    let text = format!("{number:?}");
    // Scripts take an exponent only behind a point.
    match text.split_once('e') {
        Some((digits, exponent)) if !digits.contains('.') => format!("{digits}.0e{exponent}"),
        _ => text,
    }
}

/// A call with three numbers.
pub(crate) fn spell_call(name: &str, numbers: DVec3) -> String {
    let numbers = numbers.to_array().map(spell_number);
    format!("{name}({})", numbers.join(", "))
}

/// A text in quotes.
pub(crate) fn spell_text(text: &str) -> String {
    let mut spelled = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' => spelled.push_str("\\\""),
            '\\' => spelled.push_str("\\\\"),
            '\n' => spelled.push_str("\\n"),
            '\r' => spelled.push_str("\\r"),
            '\t' => spelled.push_str("\\t"),
            letter if letter.is_control() || letter == '\u{2028}' || letter == '\u{2029}' => {
                spelled.push_str(&format!("\\U{:08x}", u32::from(letter)));
            }
            letter => spelled.push(letter),
        }
    }
    spelled.push('"');
    spelled
}
