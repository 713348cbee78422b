//! News of files that were saved.

use serde::Serialize;
use trueaxis::JsonSchema;

/// A change of a file; without a path any file may have changed.
#[derive(Debug, Clone, Default, Serialize, JsonSchema)]
pub(crate) struct ChangeEntry {
    /// Its path below the project folder.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) path: Option<String>,
    /// The version of its new text.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) version: Option<String>,
    /// The window that saved it; absent if that is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) window: Option<String>,
}
