//! Text in one form.

use super::FileError;

/// Text from bytes, as [`Files::read_text`](super::Files::read_text) gives it; `path` is for messages.
///
/// # Errors
/// Text that is not UTF-8, with its line.
pub fn decode_text(path: &str, bytes: Vec<u8>) -> Result<String, FileError> {
    let text = String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let line = error.as_bytes()[..valid]
            .iter()
            .filter(|byte| **byte == b'\n')
            .count()
            + 1;
        FileError::NotText {
            path: path.to_owned(),
            line,
        }
    })?;
    let text = match text.strip_prefix('\u{feff}') {
        Some(rest) => rest.to_owned(),
        None => text,
    };
    Ok(with_plain_line_ends(text))
}

/// Every line end as LF.
pub(crate) fn with_plain_line_ends(text: String) -> String {
    if text.contains('\r') {
        text.replace("\r\n", "\n").replace('\r', "\n")
    } else {
        text
    }
}
