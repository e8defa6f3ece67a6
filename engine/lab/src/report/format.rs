//! Numbers as a report prints them.

/// Three significant digits, without an exponent.
pub fn significant(value: f64) -> String {
    if !value.is_finite() {
        return "n/a".into();
    }
    if value == 0.0 {
        return "0".into();
    }
    let magnitude = value.abs().log10().floor() as i32;
    let decimals = (2 - magnitude).clamp(0, 6) as usize;
    format!("{value:.decimals$}")
}

/// A time with its unit, three significant digits.
pub fn milliseconds(value: f64) -> String {
    format!("{} ms", significant(value))
}

/// A number of bytes in the binary unit that keeps it below 1024.
pub fn bytes(value: u64) -> String {
    const UNITS: [&str; 4] = ["KiB", "MiB", "GiB", "TiB"];
    if value < 1024 {
        return format!("{value} B");
    }
    let mut scaled = value as f64 / 1024.0;
    let mut unit = 0;
    // 1023.9995 would be printed as 1024.
    while scaled >= 1023.95 && unit + 1 < UNITS.len() {
        scaled /= 1024.0;
        unit += 1;
    }
    let decimals = if scaled < 100.0 { 2 } else { 1 };
    format!("{scaled:.decimals$} {}", UNITS[unit])
}

/// A count with a narrow space between groups of three digits.
pub fn count(value: u64) -> String {
    let digits = value.to_string();
    let mut text = String::with_capacity(digits.len() * 2);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push('\u{202F}');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_by_hand() {
        assert_eq!(significant(12.345), "12.3");
        assert_eq!(significant(0.012_34), "0.0123");
        assert_eq!(significant(1234.5), "1234");
        assert_eq!(significant(f64::NAN), "n/a");
        assert_eq!(milliseconds(1.0), "1.00 ms");
        assert_eq!(
            (bytes(1023), bytes(1024)),
            ("1023 B".into(), "1.00 KiB".into())
        );
        assert_eq!(bytes(1_048_575), "1.00 MiB");
        assert_eq!(bytes(150 * 1024 * 1024), "150.0 MiB");
        assert_eq!(
            (count(1), count(1234), count(1_234_567)),
            (
                "1".into(),
                "1\u{202F}234".into(),
                "1\u{202F}234\u{202F}567".into()
            )
        );
    }
}
