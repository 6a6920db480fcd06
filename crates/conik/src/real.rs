//! The few real functions that `core` lacks, from the standard library or from `libm`.

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("conik needs a source of sine and square root: enable the feature `std` or `libm`");

#[cfg(feature = "std")]
mod source {
    #[inline]
    pub fn sqrt(x: f64) -> f64 {
        x.sqrt()
    }

    #[inline]
    pub fn sin_cos(x: f64) -> (f64, f64) {
        x.sin_cos()
    }

    #[inline]
    pub fn atan2(y: f64, x: f64) -> f64 {
        y.atan2(x)
    }
}

#[cfg(not(feature = "std"))]
mod source {
    pub fn sqrt(x: f64) -> f64 {
        libm::sqrt(x)
    }

    pub fn sin_cos(x: f64) -> (f64, f64) {
        libm::sincos(x)
    }

    pub fn atan2(y: f64, x: f64) -> f64 {
        libm::atan2(y, x)
    }
}

pub(crate) use source::{atan2, sin_cos, sqrt};
