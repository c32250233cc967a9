//! Responses over a key, stored for the next design.

mod carry;
mod draft;
mod linear;
mod response;
mod response_result;
mod shorter_period;
mod stored_response;
mod strain;

pub use draft::{Draft, DraftOrigin};
pub(super) use linear::LastLinear;
pub use linear::LinearCurve;
pub use response::ResponseOptions;
pub use response_result::{ResponseBifurcation, ResponseBranch, ResponseResult};
pub(super) use stored_response::StoredResponse;
