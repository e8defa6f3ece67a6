//! The bytes that a glTF file names: inside the file, in data URIs, and in files beside it.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use crate::files::{Files, join};

/// The content of all buffers.
pub(super) fn load(
    files: &Files,
    path: &str,
    document: &::gltf::Document,
    mut blob: Option<Vec<u8>>,
) -> Result<Vec<Vec<u8>>, String> {
    let mut buffers = Vec::new();
    for buffer in document.buffers() {
        let number = buffer.index();
        let bytes = match buffer.source() {
            ::gltf::buffer::Source::Bin => blob.take().ok_or_else(|| {
                format!("buffer {number} has no `uri`, and the file has no binary part")
            })?,
            ::gltf::buffer::Source::Uri(uri) => {
                read(files, path, uri).map_err(|error| format!("buffer {number}: {error}"))?
            }
        };
        if bytes.len() < buffer.length() {
            return Err(format!(
                "buffer {number} is {} bytes long, and the file says {}; was it cut off?",
                bytes.len(),
                buffer.length()
            ));
        }
        buffers.push(bytes);
    }
    Ok(buffers)
}

/// What a URI of a file stands for: a data URI, or a path relative to the file, inside the folders
/// that may be read.
pub(super) fn read(files: &Files, path: &str, uri: &str) -> Result<Vec<u8>, String> {
    if let Some(data) = uri.strip_prefix("data:") {
        let Some((_, data)) = data.split_once(";base64,") else {
            return Err("a data URI must be base64".to_owned());
        };
        return STANDARD
            .decode(data)
            .map_err(|error| format!("the data URI is damaged ({error})"));
    }
    let relative = decode_percent(uri)?;
    let target = join(path, &relative).map_err(|error| error.to_string())?;
    files.read(&target).map_err(|error| error.to_string())
}

/// Turns `%20` and the like into letters (RFC 3986, section 2.1).
fn decode_percent(uri: &str) -> Result<String, String> {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&byte, after)) = rest.split_first() {
        let hex = (byte == b'%')
            .then(|| std::str::from_utf8(after.get(..2)?).ok())
            .flatten()
            .and_then(|digits| u8::from_str_radix(digits, 16).ok());
        match hex {
            Some(decoded) => {
                bytes.push(decoded);
                rest = &after[2..];
            }
            None => {
                bytes.push(byte);
                rest = after;
            }
        }
    }
    String::from_utf8(bytes).map_err(|_| format!("the URI `{uri}` is no text"))
}
