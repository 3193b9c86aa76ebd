//! Our layouts against files of real Adams runs.

use results::{DataKind, Entity, Header, Layout, ReqWriter, ResFile, ResWriter, UnitNames};

const DELTA_ROBOT: &str = "adams-results/delta-robot-friction/delta_robot.res";

#[test]
fn real_files_are_read() {
    // (file, entities, values of a step, steps of each block)
    let files: [(&str, usize, usize, &[usize]); 4] = [
        (DELTA_ROBOT, 80, 678, &[1, 2, 200]),
        ("adams-results/free-fall/test.res", 1, 18, &[1, 1, 25]),
        (
            "adams-results/pendulum-static-dynamic/rescale_analysis.res",
            4,
            48,
            &[1, 1, 1, 500],
        ),
        (
            "adams-results/cart-pendulum/cart_pendulum.res",
            22,
            81,
            &[1, 1, 2000],
        ),
    ];
    for (path, entities, values, steps) in files {
        let Some(path) = reference_data::path(path) else {
            continue;
        };
        let file = ResFile::read(path).unwrap();
        assert_eq!(file.status.as_deref(), Some("Successful"));
        let read: Vec<_> = file.data.iter().map(|block| block.times.len()).collect();
        assert_eq!(read, steps, "{}", file.title);
        assert_eq!(file.entities.len(), entities);
        assert_eq!(file.data[0].row(0).len(), values);
    }
    if let Some(path) = reference_data::path("adams-results/free-fall/test.res") {
        let file = ResFile::read(path).unwrap();
        assert_eq!(
            file.get("PART_2_XFORM.Y").unwrap()[2..4],
            [-0.0194492123535125, -0.07736249975851248]
        );
    }
}

/// The entity we would make for one of a real file.
fn ours(real: &Entity, units: &UnitNames) -> Entity {
    let element = real.element.as_deref().unwrap();
    let id = real.object_id.unwrap();
    let count = real.components.len();
    let made = match real.kind.as_str() {
        "Part" => Entity::part(element, id, units),
        "ADAMS_Variable" => Entity::variable(element, id),
        "Plant_Input" => Entity::plant_input(element, id, count),
        "Plant_Output" => Entity::plant_output(element, id, count),
        "Friction" => Entity::friction(element, id, units),
        kind => Entity::reaction(kind, element, id, units),
    };
    // Plants are named without their model.
    match real.kind.starts_with("Plant") {
        true => Entity {
            name: real.name.clone(),
            ..made
        },
        false => made,
    }
}

/// Builds the layout of a real file from names and ids alone and compares names, units and ids.
fn compare_layout(path: &str, units: &UnitNames) {
    let Some(path) = reference_data::path(path) else {
        return;
    };
    let mut real = ResFile::read(path).unwrap();
    // Units of variables come from Adams View: a dataset does not have them.
    for entity in &mut real.entities {
        if entity.kind == "ADAMS_Variable" {
            entity.components[0].unit.clear();
        }
    }
    let made: Vec<_> = real
        .entities
        .iter()
        .map(|entity| ours(entity, units))
        .collect();
    for (made, real) in made.iter().zip(&real.entities) {
        assert_eq!(made, real);
    }
    let mut layout = Layout::new();
    let (parts, others): (Vec<_>, Vec<_>) = made.into_iter().partition(|e| e.kind == "Part");
    layout.push_family(parts, &[6, 6, 6]).unwrap();
    for entity in others {
        layout.push(entity);
    }
    assert_eq!(layout.value_count(), real.data[0].row(0).len());
    for (k, entity) in real.entities.iter().enumerate() {
        for j in 0..entity.components.len() {
            assert_eq!(
                layout.column(k, j),
                real.column_of(k, j),
                "{} {j}",
                entity.name
            );
        }
    }
}

#[test]
fn layouts_agree_with_real_ones() {
    let units =
        |length, mass, force| UnitNames::from_keywords(length, mass, force, "second").unwrap();
    compare_layout(DELTA_ROBOT, &units("meter", "kilogram", "newton"));
    compare_layout(
        "adams-results/pendulum-static-dynamic/rescale_analysis.res",
        &units("inch", "pound_mass", "pound_force"),
    );
    compare_layout(
        "adams-results/cart-pendulum/cart_pendulum.res",
        &units("millimeter", "kilogram", "newton"),
    );
}

#[test]
fn request_file_of_a_real_run() {
    let Some(path) = reference_data::path("adams-results/free-fall/test.req") else {
        return;
    };
    let real = std::fs::read_to_string(path).unwrap();
    let units = UnitNames::from_keywords("INCH", "POUND_MASS", "POUND_FORCE", "SECOND").unwrap();
    let mut made = Vec::new();
    let title = "Adams View model name: MODEL_1";
    let date = Some("2023-06-13 22:52:01");
    let mut writer = ReqWriter::new(&mut made, title, date, &units, &[]).unwrap();
    for k in 0..=25 {
        writer.step(f64::from(k) / 100.0, &[]).unwrap();
    }
    assert_eq!(String::from_utf8(made).unwrap(), real.replace("\r\n", "\n"));
}

#[test]
fn a_real_file_survives_rewriting() {
    let Some(path) = reference_data::path(DELTA_ROBOT) else {
        return;
    };
    let real = ResFile::read(path).unwrap();
    let mut layout = Layout::new();
    let (parts, others): (Vec<_>, Vec<_>) =
        (real.entities.iter().cloned()).partition(|e| e.kind == "Part");
    layout.push_family(parts, &[6, 6, 6]).unwrap();
    for entity in others {
        layout.push(entity);
    }
    let header = Header {
        title: real.title.clone(),
        ..Header::default()
    };
    let mut writer = ResWriter::new(Vec::new(), &header, layout).unwrap();
    let kinds = [
        DataKind::ModelInput,
        DataKind::InitialConditions,
        DataKind::Dynamic,
    ];
    for (block, kind) in real.data.iter().zip(kinds) {
        writer.begin_data(kind).unwrap();
        for (step, &time) in block.times.iter().enumerate() {
            writer.step(time, block.row(step)).unwrap();
        }
    }
    let bytes = writer.finish("Successful").unwrap();
    let copy = ResFile::from_reader(bytes.as_slice()).unwrap();
    // Equality of numbers here is equality of bits: both hold what the same text means.
    assert_eq!(copy.data, real.data);
    assert_eq!(copy.entities, real.entities);
}
