//! Damaged datasets and command files for tests: whatever the text, nothing panics and nothing hangs.
//!
//! The texts are made by a generator with a fixed seed, so that a failure comes again.

#![allow(clippy::print_stdout, reason = "the figures are what these tests show")]

use std::time::Instant;

/// Calls `visit` with damaged texts and returns the sum of what it returns. The environment variable
/// `variable` sets their number, `usual` without it. Each text is the same whatever the number of
/// threads.
///
/// # Panics
/// If `visit` panics.
pub fn each(variable: &str, usual: usize, visit: impl Fn(&[u8]) -> usize + Sync) -> usize {
    let wanted = std::env::var(variable).ok();
    let wanted: usize = wanted.and_then(|text| text.parse().ok()).unwrap_or(usual);
    let originals = originals();
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let start = Instant::now();
    let (count, bytes) = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads)
            .map(|worker| {
                let (originals, visit) = (&originals, &visit);
                scope.spawn(move || {
                    let (mut count, mut bytes) = (0, 0);
                    for index in (worker..wanted).step_by(threads) {
                        let text = damaged(originals, index);
                        bytes += text.len();
                        count += visit(&text);
                    }
                    (count, bytes)
                })
            })
            .collect();
        let counts = workers
            .into_iter()
            .map(|worker| worker.join().expect("no panic"));
        counts.fold((0, 0), |sum, next| (sum.0 + next.0, sum.1 + next.1))
    });
    println!(
        "{wanted} damaged texts of {} originals, {bytes} bytes, {:.1} s on {threads} threads",
        originals.len(),
        start.elapsed().as_secs_f64()
    );
    count
}

/// The damaged text of this number: each has its own seed.
fn damaged(originals: &[Vec<u8>], index: usize) -> Vec<u8> {
    let seed = 0x9E37_79B9_7F4A_7C15_u64.wrapping_mul(index as u64 + 1);
    let mut random = Random(seed);
    let mut text = originals[random.below(originals.len())].clone();
    let other = &originals[random.below(originals.len())];
    damage(&mut text, other, &mut random);
    text
}

/// Xorshift; the constant is that of Vigna's xorshift64*.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D)
    }

    fn below(&mut self, limit: usize) -> usize {
        (self.next() % limit.max(1) as u64) as usize
    }

    fn range(&mut self, length: usize, longest: usize) -> std::ops::Range<usize> {
        let start = self.below(length + 1);
        let end = length.min(start + self.below(longest));
        start..end
    }
}

/// Pieces of the language that damage likes.
const PIECES: &[&str] = &[
    "\n, ",
    ",",
    "\\",
    "=",
    "/",
    "(",
    ")",
    ":",
    ";",
    "!",
    "\"",
    "&\n",
    "\r\n",
    "\0",
    "1e999",
    "-",
    "**",
    "90D",
    "1D5",
    "0",
    "4294967296",
    "FUNCTION = ",
    "IF(",
    "VARVAL(1)",
    "END\n",
    "PART/1, GROUND\n",
    "MARKER/",
    "JOINT = ",
    "MU_STATIC = -1",
    "I_YOKE",
    "\u{b7}",
    "EXACT = X:",
    "QP = 1,",
    "IP = 1e300, 1e-300, 1e300",
    "C=",
    "CNAMES = \"",
    "file/model=",
    "sim/dyn, ",
    "deactivate/sensor, id=",
    "FRICTION(1, 27)",
    "LIST",
];

/// Small texts of our own, so that there is something to damage everywhere.
const EXAMPLES: &[&str] = &[
    "A slider\nUNITS/SYSTEM=MKS\nPART/1, GROUND\nMARKER/1, PART=1, REULER=90D, 90D, 0\n\
     PART/2, MASS=1, CM=20, IP=0.1, 0.1, 0.1, 0, 0, 0, EXACT=X:Y\nMARKER/20, PART=2\n\
     MARKER/2, PART=2, ZP=1, 0, 0, XP=0, 1, 0\nJOINT/1, TRANSLATIONAL, I=2, J=1, IC=0.1, 0\n\
     FRICTION/1, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, INPUTS=(PRELOAD, REACTION_FORCE)\n\
     SFORCE/1, I=2, J=1, ROTATIONAL, FUNCTION=STEP(TIME,0,0,1,\n, 1)*SIN(2*PI*TIME)\\\n\
     , ACTIONONLY\nVARIABLE/1, FUNCTION=IF(TIME-1: 0, DX(2,1,1), -VARVAL(2)**2)\n\
     VARIABLE/2, IC=1, FUNCTION=JOINT(1,0,2,0)\nREQUEST/1, F2=TIME\\F3=VARVAL(1)\\,C=a text\n\
     REQUEST/2, D, I=2, J=1, CNAMES=\"a\", \"b\"\nINTEGRATOR/GSTIFF, PATTERN=T:F, ERROR=1E-4\n\
     SENSOR/1, GE, VALUE=1, FUNCTION=FRICTION(1, 6)\\, HALT\n\
     GRAPHICS/1, CYLINDER, CM=1, LENGTH=2\nACCGRAV/KGRAV=-9.81\nOUTPUT/REQSAVE\nEND\n",
    "\nfile/model=slider\nsimulate/initial_conditions\nvariable/1, function=2*TIME &\n, + 1\n\
     int/hht, err=1E-7, interpolate=on\nsim/dyn, end=1.5, dtout=.005\nsim/stat\n\
     deactivate/joint, range=1,9\nactivate/friction, id=1,2\nfriction/1, list\n\
     equil/stab=1E-3\nstop\n",
    "FRICTION/1, MU_STATIC=0.2, EFFECT=SLIDING; ",
];

/// The texts that are damaged: our own and windows of the corpus.
fn originals() -> Vec<Vec<u8>> {
    let mut texts: Vec<Vec<u8>> = EXAMPLES
        .iter()
        .map(|text| text.as_bytes().to_vec())
        .collect();
    let folders = ["corpus", "adams-results"].map(reference_data::path);
    for path in folders
        .into_iter()
        .flatten()
        .flat_map(|folder| reference_data::models(&folder))
    {
        let bytes = std::fs::read(path).expect("the file can be read");
        // Windows keep a million mutations within minutes; small files are one window.
        let window = 3000;
        let step = (bytes.len() / 8).max(window);
        for start in (0..bytes.len()).step_by(step) {
            texts.push(bytes[start..bytes.len().min(start + window)].to_vec());
        }
    }
    texts
}

fn damage(text: &mut Vec<u8>, other: &[u8], random: &mut Random) {
    for _ in 0..=random.below(4) {
        let length = text.len();
        match random.below(7) {
            0 => {
                let at = random.below(length);
                if let Some(byte) = text.get_mut(at) {
                    *byte ^= 1 << random.below(8);
                }
            }
            1 => drop(text.drain(random.range(length, 40))),
            2 => {
                let copy = text[random.range(length, 200)].to_vec();
                let at = random.below(length + 1);
                text.splice(at..at, copy);
            }
            3 => {
                let piece = PIECES[random.below(PIECES.len())].bytes();
                let at = random.below(length + 1);
                text.splice(at..at, piece);
            }
            4 => {
                let piece = PIECES[random.below(PIECES.len())].bytes();
                let range = random.range(length, 12);
                text.splice(range, piece);
            }
            5 => {
                let mut lines: Vec<&[u8]> = text.split(|byte| *byte == b'\n').collect();
                let count = lines.len();
                lines.swap(random.below(count), random.below(count));
                *text = lines.join(&b'\n');
            }
            _ => {
                let copy = other[random.range(other.len(), 300)].to_vec();
                let at = random.below(length + 1);
                text.splice(at..at, copy);
            }
        }
    }
}
