use crate::api::Api;
pub(crate) fn register(_api: &mut Api) {}
