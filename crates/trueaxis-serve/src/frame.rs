//! Numbers for the page in one binary piece: a JSON header, then arrays.
//!
//! ```text
//!     u32  length of the header, little endian
//!     ...  the header, JSON; its "arrays" name what follows: {"name", "type", "count"}
//!     ...  zeros up to a multiple of 8, then each array, each up to a multiple of 8
//! ```
//!
//! Every array begins at a multiple of 8, so the page looks at it in place.

use serde::Serialize;
use serde_json::Value;
use trueaxis::JsonSchema;
use trueaxis::report::document;

/// Numbers of one kind.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Array {
    F64(Vec<f64>),
    F32(Vec<f32>),
    U32(Vec<u32>),
    U8(Vec<u8>),
}

impl Array {
    fn kind(&self) -> (&'static str, usize) {
        match self {
            Self::F64(v) => ("f64", v.len()),
            Self::F32(v) => ("f32", v.len()),
            Self::U32(v) => ("u32", v.len()),
            Self::U8(v) => ("u8", v.len()),
        }
    }

    fn append_to(&self, bytes: &mut Vec<u8>) {
        match self {
            Self::F64(v) => v.iter().for_each(|x| bytes.extend(x.to_le_bytes())),
            Self::F32(v) => v.iter().for_each(|x| bytes.extend(x.to_le_bytes())),
            Self::U32(v) => v.iter().for_each(|x| bytes.extend(x.to_le_bytes())),
            Self::U8(v) => bytes.extend(v),
        }
        bytes.resize(bytes.len().next_multiple_of(8), 0);
    }
}

/// The arrays of an answer by name.
pub(crate) type Arrays = Vec<(&'static str, Array)>;

/// A header and arrays.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Frame {
    header: Value,
    arrays: Arrays,
}

/// The header as it goes over the wire.
#[derive(Serialize)]
struct Header<'a> {
    #[serde(flatten)]
    answer: &'a Value,
    #[serde(skip_serializing_if = "Option::is_none")]
    id: Option<u64>,
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    files_read: &'a [String],
    arrays: Vec<ArrayEntry>,
}

/// An array of a binary answer.
#[derive(Serialize, JsonSchema)]
pub(crate) struct ArrayEntry {
    /// Its name.
    name: &'static str,
    /// The type of its numbers, little endian.
    #[serde(rename = "type")]
    #[schemars(extend("enum" = ["f64", "f32", "u32", "u8"]))]
    kind: &'static str,
    /// How many numbers it has.
    count: usize,
}

impl Frame {
    /// An answer, whose fields are the header, with its arrays.
    pub(crate) fn new(header: &impl Serialize, arrays: Arrays) -> Self {
        Self { header: document(header), arrays }
    }

    /// The piece as it goes over the wire; `id` is that of the request, `files_read` are those that it was made from.
    pub(crate) fn bytes(&self, id: Option<u64>, files_read: &[String]) -> Vec<u8> {
        let arrays = self.arrays.iter().map(|(name, array)| {
            let (kind, count) = array.kind();
            ArrayEntry { name, kind, count }
        });
        let arrays = arrays.collect();
        let header = Header { answer: &self.header, id, files_read, arrays };
        let header = document(&header).to_string();
        let mut bytes = (header.len() as u32).to_le_bytes().to_vec();
        bytes.extend(header.as_bytes());
        bytes.resize(bytes.len().next_multiple_of(8), 0);
        self.arrays.iter().for_each(|(_, array)| array.append_to(&mut bytes));
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn arrays_begin_at_multiples_of_eight() {
        let arrays = vec![("a", Array::U8(vec![7])), ("b", Array::F64(vec![1.5]))];
        let frame = Frame::new(&json!({}), arrays);
        let bytes = frame.bytes(Some(3), &[]);
        let length = u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]) as usize;
        let header: Value = serde_json::from_slice(&bytes[4..4 + length]).unwrap();
        assert_eq!(header["id"], 3);
        assert_eq!(header["arrays"][1], json!({ "name": "b", "type": "f64", "count": 1 }));
        let first = (4 + length).next_multiple_of(8);
        assert_eq!(bytes[first], 7);
        assert_eq!(bytes[first + 8..], 1.5_f64.to_le_bytes());
    }
}
