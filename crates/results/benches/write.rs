//! Values of a `.res` written a second: `cargo bench -p results`.
#![allow(clippy::print_stdout, reason = "a benchmark prints its figure")]

use results::{DataKind, Entity, Header, Layout, ResFile, ResWriter, UnitNames};
use std::time::Instant;

fn main() {
    let units = UnitNames::default();
    let mut layout = Layout::new();
    let parts = (2..52)
        .map(|id| Entity::part(&format!("PART_{id}"), id, &units))
        .collect();
    if let Err(error) = layout.push_family(parts, &[6, 6, 6]) {
        println!("{error}");
        return;
    }
    let count = layout.value_count();
    let steps = 2000;
    let begin = Instant::now();
    let written = (|| {
        let mut writer = ResWriter::new(Vec::new(), &Header::default(), layout)?;
        writer.begin_data(DataKind::Dynamic)?;
        for step in 0..steps {
            let time = f64::from(step) * 1e-3;
            let values: Vec<f64> = (0..count).map(|k| (time + k as f64).sin()).collect();
            writer.step(time, &values)?;
        }
        writer.finish("Successful")
    })();
    let seconds = begin.elapsed().as_secs_f64();
    let total = f64::from(steps) * count as f64;
    match written {
        Ok(bytes) => {
            println!(
                "written: {:.2e} values/s ({} bytes)",
                total / seconds,
                bytes.len()
            );
            let begin = Instant::now();
            match ResFile::from_reader(bytes.as_slice()) {
                Ok(_) => println!(
                    "read: {:.2e} values/s",
                    total / begin.elapsed().as_secs_f64()
                ),
                Err(error) => println!("{error}"),
            }
        }
        Err(error) => println!("{error}"),
    }
}
