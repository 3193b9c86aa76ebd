//! Subcommands that write models, driven from outside.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn folder(name: &str, files: &[(&str, &[u8])]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    for (file, bytes) in files {
        std::fs::write(folder.join(file), bytes).unwrap();
    }
    folder
}

fn stiction(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_stiction"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

fn code(output: &Output) -> i32 {
    output.status.code().unwrap()
}

fn errors(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

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
    let other = stiction(&folder, &["fmt", "none.adm", "good.txt"]);
    assert_eq!(code(&other), 2, "{}", errors(&other));
}
