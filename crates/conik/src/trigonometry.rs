//! Sines and cosines of all joint angles at once.
//!
//! Half of the time of forward kinematics would be a call of the system's sine and cosine for each
//! joint. What is here has no branches, so that the compiler turns two angles at a time, and gives the
//! same bits on every system.
//!
//! The angle is reduced to |r| ≤ π/4 by the nearest multiple of π/2, which is taken off in three parts
//! (Cody and Waite); what the rounding of r loses is carried along. The polynomials for r, and their
//! evaluation, are those of FreeBSD's msun (Sun Microsystems, 1993). Errors stay below 1 unit in the
//! last place; angles beyond [`FAR`] go to the system.

use crate::real;

/// Angles of larger magnitude [rad] lose too much in the reduction: with fewer multiples of π/2 than
/// this needs, no floating-point number comes so near to one of them that its bits would run out.
const FAR: f64 = 64.0;

/// Adding this to a number of moderate size rounds it to an integer, which then stands in the last bits.
const ROUNDER: f64 = 6_755_399_441_055_744.0; // 1.5 · 2⁵²

/// π/2 in parts of 33 bits, so that products with the multiples in use are exact, and what is left.
const HALF_PI: [f64; 3] = [
    1.570_796_326_734_125_6,
    6.077_100_506_303_966e-11,
    2.022_266_248_795_950_6e-21,
];

/// sin r ≈ r + SINE₀ r³ + SINE₁ r⁵ + …
const SINE: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_49e-3,
    -1.984_126_982_985_795e-4,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];

/// cos r ≈ 1 − r²/2 + COSINE₀ r⁴ + COSINE₁ r⁶ + …
const COSINE: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// Writes the sine and the cosine of each angle [rad].
pub(crate) fn sin_cos(angles: &[f64], sines: &mut [f64], cosines: &mut [f64]) {
    if angles.iter().all(|angle| angle.abs() <= FAR) {
        for ((angle, sin), cos) in angles.iter().zip(sines).zip(cosines) {
            (*sin, *cos) = sin_cos_near(*angle);
        }
    } else {
        for ((angle, sin), cos) in angles.iter().zip(sines).zip(cosines) {
            (*sin, *cos) = real::sin_cos(*angle);
        }
    }
}

#[inline(always)]
#[allow(
    clippy::inline_always,
    reason = "only in a loop can it become two at a time"
)]
fn sin_cos_near(angle: f64) -> (f64, f64) {
    let rounded = angle * core::f64::consts::FRAC_2_PI + ROUNDER;
    let quadrant = rounded.to_bits();
    let (r, lost) = reduce(angle, rounded - ROUNDER);
    let (sin, cos) = (sine(r, lost), cosine(r, lost));

    // Each quarter turn swaps the two; the sine is negative in quadrants 2 and 3, the cosine in 1 and 2.
    let swap = 0_u64.wrapping_sub(quadrant & 1);
    let (sin, cos) = (sin.to_bits(), cos.to_bits());
    let difference = (sin ^ cos) & swap;
    let sign_of_sin = (quadrant & 2) << 62;
    let sign_of_cos = ((quadrant + 1) & 2) << 62;
    (
        f64::from_bits(sin ^ difference ^ sign_of_sin),
        f64::from_bits(cos ^ difference ^ sign_of_cos),
    )
}

/// angle − multiple · π/2, and what its rounding lost.
#[inline(always)]
#[allow(clippy::inline_always, reason = "part of the loop in `sin_cos`")]
fn reduce(angle: f64, multiple: f64) -> (f64, f64) {
    let first = angle - multiple * HALF_PI[0];
    let second = first - multiple * HALF_PI[1];
    let rest = multiple * HALF_PI[2] - ((first - second) - multiple * HALF_PI[1]);
    let r = second - rest;
    (r, (second - r) - rest)
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "part of the loop in `sin_cos`")]
fn sine(r: f64, lost: f64) -> f64 {
    let z = r * r;
    let cube = z * r;
    let tail = SINE[1] + z * (SINE[2] + z * (SINE[3] + z * (SINE[4] + z * SINE[5])));
    r - ((z * (0.5 * lost - cube * tail) - lost) - cube * SINE[0])
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "part of the loop in `sin_cos`")]
fn cosine(r: f64, lost: f64) -> f64 {
    let z = r * r;
    let tail = z * (COSINE[0] + z * (COSINE[1] + z * COSINE[2]))
        + z * z * z * z * (COSINE[3] + z * (COSINE[4] + z * COSINE[5]));
    let half = 0.5 * z;
    let head = 1.0 - half;
    head + (((1.0 - head) - half) + (z * tail - r * lost))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// How many floating-point numbers lie between the two.
    fn units_apart(a: f64, b: f64) -> u64 {
        let place = |x: f64| {
            let magnitude = (x.to_bits() & (u64::MAX >> 1)).cast_signed();
            if x.is_sign_negative() {
                -magnitude
            } else {
                magnitude
            }
        };
        place(a).abs_diff(place(b))
    }

    fn assert_as_the_system(angle: f64) {
        let (mut sin, mut cos) = ([0.0], [0.0]);
        sin_cos(&[angle], &mut sin, &mut cos);
        let (expected_sin, expected_cos) = real::sin_cos(angle);
        assert!(units_apart(sin[0], expected_sin) <= 1, "sine of {angle:e}");
        assert!(
            units_apart(cos[0], expected_cos) <= 1,
            "cosine of {angle:e}"
        );
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]
        #[test]
        fn sines_and_cosines_are_the_systems_to_one_unit_in_the_last_place(
            angle in -FAR..FAR,
            small in -1.0..1.0_f64,
        ) {
            assert_as_the_system(angle);
            assert_as_the_system(small);
        }
    }

    #[test]
    fn nothing_is_lost_where_a_sine_or_cosine_is_almost_zero() {
        for multiple in -41..=41 {
            let zero = f64::from(multiple) * core::f64::consts::FRAC_PI_2;
            for angle in [
                zero.next_down(),
                zero,
                zero.next_up(),
                zero + 1e-9,
                zero - 1e-5,
            ] {
                assert_as_the_system(angle);
            }
        }
        for angle in [
            0.0,
            -0.0,
            5e-324,
            -1e-300,
            1e-9,
            core::f64::consts::FRAC_PI_4,
        ] {
            assert_as_the_system(angle);
        }
    }

    #[test]
    fn far_angles_and_what_is_no_angle_go_to_the_system() {
        for angle in [FAR, 65.0, -1e5, 1e22, f64::MAX] {
            assert_as_the_system(angle);
        }
        let (mut sin, mut cos) = ([0.0; 3], [0.0; 3]);
        sin_cos(&[f64::NAN, 1.0, f64::INFINITY], &mut sin, &mut cos);
        assert!(sin[0].is_nan() && cos[0].is_nan() && sin[2].is_nan());
        assert_eq!((sin[1], cos[1]), real::sin_cos(1.0));
    }
}
