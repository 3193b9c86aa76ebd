//! Writing and reading `.res` files: round trip, cut files, refused values, bad input.

use results::{
    Component, DataKind, Entity, FRICTION_DETAIL, Header, Layout, ReadError, ResFile, ResWriter,
    SurfaceMotion, UnitNames, WriteError,
};

/// A model with every kind of entity and awkward names.
fn layout() -> Layout {
    let units = UnitNames::default();
    let mut layout = Layout::new();
    let parts = vec![
        Entity::part("ARM <1> & \"co\"", 2, &units),
        Entity::part("Käfig", 3, &units),
    ];
    layout.push_family(parts, &[6, 6, 6]).unwrap();
    layout.push(Entity::reaction("Joint", "J1", 1, &units));
    layout.push(Entity::variable("V", 1));
    layout.push(Entity::plant_input("P", 1, 3));
    layout.push(Entity::friction("F", 7, &units));
    layout.push(Entity::request("R", 9, vec![Component::new("X", "meter")]));
    layout
}

/// Repeatable finite numbers of every size, with a few special ones among them.
fn numbers(count: usize, mut state: u64) -> Vec<f64> {
    let special = [
        0.0,
        -0.0,
        5e-324,
        f64::MIN_POSITIVE,
        f64::MAX,
        f64::MIN,
        0.1,
        1e16,
        1e-5,
        -42.0,
    ];
    (0..count)
        .map(|_| {
            loop {
                state = state
                    .wrapping_mul(6364136223846793005)
                    .wrapping_add(1442695040888963407);
                let bits = state ^ (state >> 29);
                let value = if bits.is_multiple_of(7) {
                    special[(bits >> 8) as usize % 10]
                } else {
                    f64::from_bits(bits)
                };
                if value.is_finite() {
                    break value;
                }
            }
        })
        .collect()
}

const STEPS: usize = 40;

/// A file of three blocks with the rows that were written.
fn written() -> (Vec<u8>, Vec<(f64, Vec<f64>)>) {
    let header = Header {
        title: "a <title> & more".into(),
        ..Header::default()
    };
    let mut writer = ResWriter::new(Vec::new(), &header, layout()).unwrap();
    let count = writer.layout().value_count();
    let mut rows = Vec::new();
    for (k, kind) in [DataKind::ModelInput, DataKind::Dynamic, DataKind::Dynamic]
        .into_iter()
        .enumerate()
    {
        writer.begin_data(kind).unwrap();
        for step in 0..if k == 0 { 1 } else { STEPS } {
            let time = step as f64 * 0.1;
            let values = numbers(count, (100 * k + step) as u64);
            writer.step(time, &values).unwrap();
            rows.push((time, values));
        }
    }
    (writer.finish("Successful").unwrap(), rows)
}

fn assert_same_bits(a: &[f64], b: &[f64]) {
    assert_eq!(a.len(), b.len());
    assert!(
        a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits()),
        "{a:?} {b:?}"
    );
}

fn rows_of(file: &ResFile) -> Vec<(f64, Vec<f64>)> {
    let of_block = |block: &results::DataBlock| {
        (0..block.times.len())
            .map(|k| (block.times[k], block.row(k).to_vec()))
            .collect::<Vec<_>>()
    };
    file.data.iter().flat_map(of_block).collect()
}

#[test]
fn reads_back_what_was_written() {
    let (bytes, rows) = written();
    let file = ResFile::from_reader(bytes.as_slice()).unwrap();
    assert_eq!(file.entities, layout().entities());
    assert_eq!(
        (file.title.as_str(), file.status.as_deref()),
        ("a <title> & more", Some("Successful"))
    );
    let names: Vec<_> = file.data.iter().map(|block| block.name.as_str()).collect();
    assert_eq!(names, ["modelInput_001", "dynamic_001", "dynamic_002"]);
    let read = rows_of(&file);
    assert_eq!(read.len(), 1 + 2 * STEPS);
    for (read, written) in read.iter().zip(&rows) {
        assert_eq!(read.0, written.0);
        assert_same_bits(&read.1, &written.1);
    }
    // By name, through the interleaved parts: the second part's VX is value 6 + 6 + 6.
    let series = file.get("Käfig_XFORM.VX").unwrap();
    assert_same_bits(
        &series,
        &rows.iter().map(|row| row.1[18]).collect::<Vec<_>>(),
    );
    assert_same_bits(&file.get("Käfig.VX").unwrap(), &series);
    assert_eq!(file.get("time.TIME").unwrap()[2], 0.1);
    assert_eq!(file.block("dynamic_002").unwrap().column(18).count(), STEPS);
    assert!(matches!(
        file.get("Käfig.QX"),
        Err(ReadError::NoComponent(_))
    ));
}

#[test]
fn layout_of_the_text() {
    let (bytes, _) = written();
    let text = String::from_utf8(bytes).unwrap();
    let first = text
        .split("<Step type=\"dynamic\">")
        .nth(2)
        .unwrap()
        .split("</Step>")
        .next()
        .unwrap();
    let lines: Vec<_> = first.split('\n').collect();
    // One newline, the time, six lines of parts, then one line an entity.
    assert_eq!(lines[..2], ["", "0.1"]);
    let words: Vec<_> = lines[2..13]
        .iter()
        .map(|line| line.split(' ').count())
        .collect();
    assert_eq!(words, [6, 6, 6, 6, 6, 6, 6, 1, 3, 26, 1]);
    assert_eq!(lines[13..], [""]);
    assert!(!first.contains("  "));
    assert!(text.contains("<Data name=\"dynamic_002\" id=\"3\">\n<Step type=\"dynamic\">\n"));
    assert!(text.contains("<Step type=\"input\">"));
    assert!(
        text.contains("<Component name=\"X\" unitsValue=\"meter\" plotLabel=\"X\" id=\"74\" />")
    );
    assert!(text.contains("<Component name=\"MU1\" id=\"60\" />"));
}

#[test]
fn a_cut_file_keeps_its_steps() {
    let (bytes, rows) = written();
    let map_ends = String::from_utf8_lossy(&bytes).find("</StepMap>").unwrap() + 10;
    let mut most = 0;
    for end in (0..bytes.len()).step_by(13) {
        let cut = &bytes[..end];
        // Inside a letter of two bytes the file is no UTF-8.
        if std::str::from_utf8(cut).is_err() {
            continue;
        }
        match ResFile::from_reader(cut) {
            Ok(file) => {
                assert!(end >= map_ends);
                let whole = String::from_utf8_lossy(cut).matches("</Step>").count();
                let read = rows_of(&file);
                assert_eq!(read.len(), whole, "cut at {end}");
                for (read, written) in read.iter().zip(&rows) {
                    assert_same_bits(&read.1, &written.1);
                }
                most = most.max(whole);
            }
            Err(error) => assert!(end < map_ends, "cut at {end}: {error}"),
        }
    }
    assert_eq!(most, rows.len());
}

#[test]
fn every_step_is_written_at_once() {
    // A file whose writer just disappears, as in a crash.
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("crash.res");
    let mut writer = ResWriter::new(
        std::fs::File::create(&path).unwrap(),
        &Header::default(),
        layout(),
    )
    .unwrap();
    writer.begin_data(DataKind::Dynamic).unwrap();
    let values = numbers(writer.layout().value_count(), 5);
    for k in 1..=3 {
        writer.step(f64::from(k), &values).unwrap();
        let file = ResFile::read(&path).unwrap();
        assert_eq!(file.data[0].times.len(), k as usize);
        assert_eq!(file.status, None);
    }
    std::mem::forget(writer);
}

#[test]
fn refused_steps_leave_no_trace() {
    let mut writer = ResWriter::new(Vec::new(), &Header::default(), layout()).unwrap();
    let mut values = vec![1.0; writer.layout().value_count()];
    assert!(matches!(
        writer.step(0.0, &values),
        Err(WriteError::OutsideData)
    ));
    writer.begin_data(DataKind::Dynamic).unwrap();
    writer.step(1.0, &values).unwrap();
    values[7] = f64::NAN;
    let error = writer.step(2.0, &values).unwrap_err().to_string();
    assert_eq!(error, "Käfig_XFORM.Y is NaN at time 2");
    assert!(writer.step(f64::INFINITY, &[]).is_err());
    assert!(matches!(
        writer.step(2.0, &[]),
        Err(WriteError::ValueCount { given: 0, .. })
    ));
    values[7] = 1.0;
    assert!(matches!(
        writer.step(f64::NAN, &values),
        Err(WriteError::NotFinite { .. })
    ));
    let file = ResFile::from_reader(writer.finish("Failed").unwrap().as_slice()).unwrap();
    assert_eq!(file.data[0].times, [1.0]);
    assert_eq!(file.status.as_deref(), Some("Failed"));
}

#[test]
fn families_must_fit_their_blocks() {
    let units = UnitNames::default();
    let mut layout = Layout::new();
    let family = vec![Entity::part("A", 2, &units), Entity::variable("B", 3)];
    let error = layout.push_family(family, &[6, 6, 6]).unwrap_err();
    assert_eq!((error.components, error.expected), (1, 18));
    assert_eq!(layout, Layout::new());
    // Blocks of two and four: both pairs first, then both fours.
    let family = ["A", "B"].map(|name| Entity::reaction("Joint", name, 1, &units));
    assert_eq!(layout.push_family(family.to_vec(), &[2, 4]).unwrap(), 0..12);
    assert_eq!([0, 1, 2, 5].map(|k| layout.column(0, k)), [0, 1, 4, 7]);
    assert_eq!([0, 1, 2, 5].map(|k| layout.column(1, k)), [2, 3, 8, 11]);
    assert_eq!(layout.name_of(8).as_deref(), Some("B.FZ"));
    assert_eq!(layout.name_of(12), None);
}

#[test]
fn damaged_files_are_errors() {
    let (bytes, _) = written();
    let text = String::from_utf8(bytes).unwrap();
    let read = |text: &str| ResFile::from_reader(text.as_bytes());
    assert!(matches!(read(""), Err(ReadError::NoStepMap)));
    assert!(matches!(read("PART/1, GROUND"), Err(ReadError::NoStepMap)));
    let with = |from: &str, to: &str| read(&text.replacen(from, to, 1)).unwrap_err().to_string();
    assert!(with("\n0.1\n", "\nnan\n").contains("step 2 of dynamic_001: `nan`"));
    assert!(with("\n0.1\n", "\n0.1 7\n").contains("75 numbers instead of 74"));
    assert!(with(" id=\"9\"", " id=\"8\"").contains("used twice"));
    assert!(with(" id=\"9\"", " id=\"900000000000\"").contains("beyond"));
    assert!(with(" id=\"9\"", " id=\"0\"").contains("id"));
    assert!(with("</Entity>", "</Unit>").contains("Entity"));
    assert!(with("<Entity name=\"time\">", "").contains("component outside of an entity"));
}

#[test]
fn no_mutation_panics() {
    let (bytes, _) = written();
    let map_ends = String::from_utf8_lossy(&bytes).find("<Data").unwrap() + 3000;
    let mut state = 1u64;
    let mut random = |below: usize| {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 33) as usize % below
    };
    let pieces: [&[u8]; 8] = [
        b"<",
        b">",
        b"\"",
        b"&#x0;",
        b"</Step>",
        b"</StepMap>",
        b"<Data>",
        b"\xff",
    ];
    let mut failed = 0;
    for _ in 0..3000 {
        let mut file = bytes[..map_ends].to_vec();
        for _ in 0..1 + random(3) {
            let place = random(file.len());
            let end = (place + random(40)).min(file.len());
            file.splice(place..end, pieces[random(8)].iter().copied());
        }
        failed += usize::from(ResFile::from_reader(file.as_slice()).is_err());
    }
    assert!(failed > 1000, "mutations do little: {failed}");
}

#[test]
fn what_is_ours_comes_last_and_moves_nothing() {
    let units = UnitNames::default();
    let write = |ours: bool| {
        let mut layout = Layout::new();
        layout
            .push_family(vec![Entity::part("BAR", 2, &units)], &[6, 6, 6])
            .unwrap();
        layout.push(Entity::friction("PIN", 3, &units));
        if ours {
            let motion = SurfaceMotion::SlidingAndTurning;
            layout.push(Entity::friction_detail("PIN", 3, motion, true, &units));
        }
        let values: Vec<f64> = (0..layout.value_count()).map(|k| k as f64).collect();
        let mut file = Vec::new();
        let mut writer = ResWriter::new(&mut file, &Header::default(), layout).unwrap();
        writer.begin_data(DataKind::Dynamic).unwrap();
        writer.step(0.5, &values).unwrap();
        writer.finish("Successful").unwrap();
        ResFile::from_reader(file.as_slice()).unwrap()
    };
    let (without, with) = (write(false), write(true));
    for entity in &without.entities {
        for component in &entity.components {
            let name = format!("{}.{}", entity.name, component.name);
            assert_eq!(with.column(&name), without.column(&name), "{name}");
        }
    }
    let own = with.entities.last().unwrap();
    assert_eq!(
        (own.kind.as_str(), own.object_id),
        (FRICTION_DETAIL, Some(3))
    );
    // A cylindrical joint has both deflections and both drifts; all have the units of their kind.
    let units: Vec<(&str, &str)> = own
        .components
        .iter()
        .map(|component| (component.name.as_str(), component.unit.as_str()))
        .collect();
    assert_eq!(units.len(), 21 + 6 + 2);
    for pair in [
        ("REGIME", ""),
        ("LOAD_BENDING", "newton"),
        ("BY_PRELOAD", "newton"),
        ("POWER", "newton-meter/sec"),
        ("DISSIPATED", "newton-meter"),
        ("STICK_END", "sec"),
        ("BRISTLE_Z", "meter"),
        ("BRISTLE_AZ", "meter"),
        ("DRIFT_A", "meter"),
    ] {
        assert!(units.contains(&pair), "{pair:?}");
    }
    assert_eq!(with.get("PIN_DETAIL.REGIME").unwrap(), [18.0 + 26.0]);
}
