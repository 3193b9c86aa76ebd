//! Subcommands that write models, driven from outside.

mod shared;

use shared::{code, errors, folder, stiction};

#[test]
fn fmt_replaces_what_it_can_read_and_leaves_the_rest_alone() {
    let good: &[u8] = b"size \xB7\r\nPART/1,GROUND\r\nEND";
    let bad: &[u8] = b"title\nPART/1,GRUND\n";
    let command: &[u8] = b"\nfile/model = good\n";
    let files = [("good.adm", good), ("bad.adm", bad), ("c.acf", command)];
    let folder = folder("fmt", &files);
    let read = |file: &str| std::fs::read(folder.join(file)).unwrap();

    let check = stiction(&folder, &["fmt", "--check", "good.adm", "c.acf"]);
    assert_eq!(code(&check), 1);
    assert_eq!(
        errors(&check),
        "good.adm: the layout would change\nc.acf: the layout would change\n"
    );
    assert_eq!(read("good.adm"), good);

    let laid_out: &[u8] = b"size \xB7\r\nPART/1\r\n, GROUND\r\nEND\r\n";
    let shown = stiction(&folder, &["fmt", "--stdout", "good.adm"]);
    assert_eq!((code(&shown), shown.stdout.as_slice()), (0, laid_out));
    assert_eq!(read("good.adm"), good);

    let written = stiction(&folder, &["fmt", "good.adm", "bad.adm", "c.acf"]);
    assert_eq!(code(&written), 3);
    let said = errors(&written);
    assert!(
        said.starts_with("bad.adm:2:8: error[unknown-argument]"),
        "{said}"
    );
    assert_eq!(read("good.adm"), laid_out);
    assert_eq!(read("bad.adm"), bad);
    assert_eq!(read("c.acf"), b"\nfile/model=good\n");
    assert_eq!(
        std::fs::read_dir(&folder).unwrap().count(),
        3,
        "nothing is left behind"
    );

    let again = stiction(&folder, &["fmt", "--check", "good.adm", "c.acf"]);
    assert_eq!((code(&again), errors(&again).as_str()), (0, ""));
    for (arguments, status) in [
        (["fmt", "good.txt"], 2),
        // As `check` and `run` end for a file that is not there.
        (["fmt", "none.adm"], 3),
        (["convert", "none.adm"], 3),
        (["check", "none.adm"], 3),
    ] {
        let other = stiction(&folder, &arguments);
        assert_eq!(code(&other), status, "{}", errors(&other));
    }
}

#[test]
fn convert_goes_to_json_and_back() {
    let model: &[u8] = b"size \xB7\n!\nPART/1\n, GROUND\n!\nMARKER/1\n, PART = 1\n\
        , REULER = 90D, 0, -1E-300\n!\nEND\n";
    let folder = folder("convert", &[("m.adm", model)]);
    let output = stiction(&folder, &["convert", "m.adm", "-o", "m.json"]);
    assert_eq!(code(&output), 0, "{}", errors(&output));
    let json: serde_json::Value =
        serde_json::from_slice(&std::fs::read(folder.join("m.json")).unwrap()).unwrap();
    assert_eq!(json["title"], "size \u{b7}");
    assert_eq!(json["statements"][1]["REULER"][0]["degrees"], 90);

    let refused = stiction(&folder, &["convert", "m.json", "-o", "m.adm"]);
    assert_eq!(code(&refused), 2);
    assert!(errors(&refused).contains("--force"), "{}", errors(&refused));
    let back = stiction(&folder, &["convert", "m.json"]);
    assert_eq!((code(&back), back.stdout.as_slice()), (0, model));
    let back = stiction(&folder, &["convert", "m.json", "-o", "m.adm", "--force"]);
    assert_eq!(code(&back), 0);
    assert_eq!(std::fs::read(folder.join("m.adm")).unwrap(), model);

    std::fs::write(folder.join("bad.json"), "{\n\"format\": 1}").unwrap();
    let refused = stiction(&folder, &["convert", "bad.json"]);
    assert_eq!(code(&refused), 3);
    let said = errors(&refused);
    assert!(
        said.contains("bad.json:2:11: error[invalid-value]: expected a string"),
        "{said}"
    );
}
