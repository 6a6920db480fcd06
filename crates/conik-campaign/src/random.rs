//! Random numbers that are the same everywhere.

/// `SplitMix64` (Steele, Lea and Flood, 2014).
#[derive(Clone, Debug)]
pub(crate) struct Random {
    state: u64,
}

impl Random {
    /// The stream of one run: streams of different seeds and runs have nothing in common.
    pub(crate) fn new(seed: u64, run: u64) -> Self {
        let mut random = Self { state: seed };
        random.state = random.next() ^ run.wrapping_mul(0xd134_2543_de82_ef95);
        random
    }

    fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [from, to).
    pub(crate) fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * ((self.next() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// One of them, if there is any.
    pub(crate) fn one_of(&mut self, values: &[f64]) -> Option<f64> {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "in [0, length)"
        )]
        let at = self.between(0.0, values.len() as f64) as usize;
        values.get(at).copied()
    }

    /// Uniform in a ball around the origin.
    pub(crate) fn in_ball(&mut self, radius: f64) -> [f64; 3] {
        loop {
            let point = [(); 3].map(|()| self.between(-1.0, 1.0));
            if point.iter().map(|x| x * x).sum::<f64>() <= 1.0 {
                return point.map(|x| radius * x);
            }
        }
    }
}
