//! Noise for every port of a controller, the same in every run: good messages in any order, good
//! messages spoilt, sizes that lie, and bytes at random.
//!
//! Shared by `tests/noise.rs` (over sockets), `src/emulator/noise.rs` (without) and
//! `tests/driver/noise.rs` (a controller that goes mad).

/// Bytes of a message beyond which repeating what is there stops.
const LONGEST: usize = 5000;

/// How often each port is sent something where `CONIK_NOISE_PACKAGES` says nothing else.
pub fn packages_or(usual: u64) -> u64 {
    std::env::var("CONIK_NOISE_PACKAGES")
        .ok()
        .and_then(|count| count.parse().ok())
        .unwrap_or(usual)
}

/// Marsaglia's xorshift.
pub struct Noise(u64);

impl Noise {
    /// Noise of its own for each `seed`.
    pub fn new(seed: u64) -> Self {
        Self(0x1234_5678_9ABC_DEF1 ^ seed.wrapping_mul(0x9E37_79B9_7F4A_7C15))
    }

    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// A number below `limit`, which is not zero.
    #[allow(clippy::cast_possible_truncation)] // Below the limit.
    pub fn below(&mut self, limit: usize) -> usize {
        (self.next() % limit as u64) as usize
    }

    fn byte(&mut self) -> u8 {
        self.next().to_be_bytes()[0]
    }

    fn bytes(&mut self, count: usize) -> Vec<u8> {
        (0..count).map(|_| self.byte()).collect()
    }

    /// Something for a port that takes `good` messages.
    pub fn message(&mut self, good: &Good) -> Vec<u8> {
        match self.below(16) {
            0..4 => good.messages[self.below(good.messages.len())].clone(),
            4..14 => self.spoilt(good),
            14 if good.is_framed => {
                let size = [0, 1, 2, 3, 4, 255, 256, 0x7FFF, 0xFFFE, 0xFFFF][self.below(10)];
                let kind = b"VvMUOISP"[self.below(8)];
                let size: u16 = size;
                let count = self.below(40);
                [&size.to_be_bytes(), &[kind][..], &self.bytes(count)].concat()
            }
            14 => vec![self.byte(); self.below(LONGEST)],
            _ => {
                let count = self.below(80);
                self.bytes(count)
            }
        }
    }

    /// A good message with some bytes changed, cut, inserted, repeated or exchanged with another's;
    /// mostly with a size that fits it again.
    fn spoilt(&mut self, good: &Good) -> Vec<u8> {
        let mut bytes = good.messages[self.below(good.messages.len())].clone();
        for _ in 0..=self.below(4) {
            let at = self.below(bytes.len() + 1);
            match self.below(6) {
                0 => bytes.truncate(at),
                1 => bytes.insert(at, self.byte()),
                2 if bytes.len() < LONGEST => bytes.extend_from_within(..at),
                3 => {
                    let other = &good.messages[self.below(good.messages.len())];
                    let from = self.below(other.len());
                    bytes.truncate(at);
                    bytes.extend_from_slice(&other[from..]);
                }
                4 => {
                    // A number that is none, or as large as can be.
                    let odd = [f64::NAN, f64::INFINITY, f64::MAX, -1.0][self.below(4)];
                    for (byte, odd) in bytes[at..].iter_mut().zip(odd.to_be_bytes()) {
                        *byte = odd;
                    }
                }
                _ => {
                    if let Some(byte) = bytes.get_mut(at) {
                        *byte = self.byte();
                    }
                }
            }
        }
        if good.is_framed && bytes.len() >= 3 && self.below(8) != 0 {
            let size = u16::try_from(bytes.len()).unwrap_or(u16::MAX).to_be_bytes();
            bytes[..2].copy_from_slice(&size);
        }
        bytes
    }
}

/// What a port takes.
pub struct Good {
    messages: Vec<Vec<u8>>,
    /// Whether each begins with its size and kind.
    is_framed: bool,
}

// Each of those who share this file leaves something of it alone.
#[allow(dead_code)]
impl Good {
    /// Packages of RTDE.
    pub fn packages(messages: Vec<Vec<u8>>) -> Self {
        Self {
            messages,
            is_framed: true,
        }
    }

    /// One more.
    pub fn add(&mut self, message: Vec<u8>) {
        self.messages.push(message);
    }
}

/// A package of RTDE.
#[allow(dead_code)]
pub fn framed(kind: u8, payload: &[u8]) -> Vec<u8> {
    let size = u16::try_from(payload.len() + 3).unwrap().to_be_bytes();
    [&size, &[kind][..], payload].concat()
}

/// Good messages for the port that has this number at a controller.
#[allow(dead_code)]
pub fn good_for(port: u16) -> Good {
    match port {
        30_004 => {
            let outputs = |hz: f64, names: &str| {
                framed(b'O', &[&hz.to_be_bytes(), names.as_bytes()].concat())
            };
            let inputs = "input_int_register_24,input_int_register_25,input_double_register_24,";
            Good {
                messages: vec![
                    framed(b'V', &[0, 2]),
                    framed(b'V', &[0, 1]),
                    framed(b'v', &[]),
                    outputs(500.0, "timestamp,actual_q"),
                    outputs(
                        125.0,
                        "timestamp,robot_mode,safety_status,target_q,output_int_register_24",
                    ),
                    framed(b'O', b"timestamp,actual_TCP_pose"),
                    framed(b'I', inputs.as_bytes()),
                    framed(
                        b'I',
                        b"speed_slider_mask,speed_slider_fraction,external_force_torque",
                    ),
                    framed(
                        b'U',
                        &[&[1][..], &[0, 0, 0, 9, 0, 0, 0, 1], &0.1_f64.to_be_bytes()].concat(),
                    ),
                    framed(
                        b'U',
                        &[&[2][..], &[0, 0, 0, 1], &0.5_f64.to_be_bytes(), &[0; 48]].concat(),
                    ),
                    framed(b'S', &[]),
                    framed(b'P', &[]),
                    framed(b'M', b"\x02hi\x02me\x01"),
                ],
                is_framed: true,
            }
        }
        29_999 => lines(&[
            "power on",
            "power off",
            "brake release",
            "play",
            "pause",
            "stop",
            "load a.urp",
            "unlock protective stop",
            "restart safety",
            "robotmode",
            "safetymode",
            "programState",
            "get loaded program",
            "popup x",
            "quit",
            "emulator protective stop",
            "emulator emergency stop",
            "emulator release",
            "emulator drop 0.5",
            "emulator delay 0.1",
            "emulator jitter 0.1",
            "emulator freeze 0.1",
            "emulator one-byte on",
            "emulator one-byte off",
            "emulator bad packages 3",
            "emulator clock jump 1",
            "emulator restart clock",
            "emulator register in use input_int_register_40",
            "emulator half-open",
            "emulator program stop",
            "emulator pause",
        ]),
        // No program that dials: a spoilt address could be anybody's.
        _ => {
            let mut good = lines(&[
                "def rtde_control():\n global reg_offset_float = 24\n global reg_offset_int = 24\nend",
                "def f():\n  while (True):\n    sync()\n  end\nend",
                "sec g():\n  set_digital_out(0, True)\nend",
                "servoj([0,0,0,0,0,0],t=0.002,lookahead_time=0.1,gain=300)",
                "movej([0, -1.57, 0, -1.57, 0, 0], a=1.4, v=1.05)",
                "power on",
                "power off",
                "set robotmode run",
                "set unlock protective stop",
                "stop program",
                "stopj(2)",
                "textmsg(\"x\")",
            ]);
            good.add(include_bytes!("../../src/servo.script").to_vec());
            good
        }
    }
}

#[allow(dead_code)]
fn lines(lines: &[&str]) -> Good {
    Good {
        messages: lines
            .iter()
            .map(|line| format!("{line}\n").into_bytes())
            .collect(),
        is_framed: false,
    }
}
