//! Models as JSON: there and back, the schema, and what is wrong with JSON that is no model.
//!
//! `STICTION_RENEW=1 cargo test -p dataset json` writes docs/model.schema.json anew.

use crate::shared::without_places;
use boon::{Compiler, SchemaIndex, Schemas};
use dataset::{Language, Source, from_json, json_schema, read_dataset, to_json};
use proptest::prelude::*;
use proptest::test_runner::{RngAlgorithm, TestRng, TestRunner};
use serde_json::{Map, Value, json};
use std::path::Path;

fn source(text: &str) -> Source {
    Source::from_text("text", text.to_string())
}

/// The dataset of a JSON text, or all messages.
fn dataset_of(json: &str) -> Result<String, String> {
    let source = source(json);
    from_json(&source).map_err(|errors| {
        let rendered = errors.iter().map(|error| error.render(&source));
        rendered.collect()
    })
}

fn json_of(text: &str) -> Result<String, String> {
    let source = source(text);
    to_json(&source).map_err(|errors| errors[0].render(&source))
}

struct Schema {
    schemas: Schemas,
    index: SchemaIndex,
}

impl Schema {
    fn new() -> Self {
        let text: Value = serde_json::from_str(&json_schema()).expect("the schema is JSON");
        let mut schemas = Schemas::new();
        let mut compiler = Compiler::new();
        compiler
            .add_resource("model.json", text)
            .expect("a resource");
        let index = compiler.compile("model.json", &mut schemas);
        let index = index.expect("the schema is a schema");
        Self { schemas, index }
    }

    fn check(&self, model: &Value) -> Result<(), String> {
        let checked = self.schemas.validate(model, self.index);
        checked.map_err(|error| error.to_string())
    }
}

#[test]
fn the_published_schema_is_that_of_the_tables() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/model.schema.json");
    if std::env::var_os("STICTION_RENEW").is_some() {
        std::fs::write(&path, json_schema()).expect("the schema can be written");
    }
    let published = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        published == json_schema(),
        "docs/model.schema.json is stale; renew it with STICTION_RENEW=1 cargo test -p dataset json"
    );
}

#[test]
fn real_models_come_back_the_same() {
    let schema = Schema::new();
    let mut files = 0;
    let mut refused = Vec::new();
    let folders = ["corpus", "adams-results"].map(reference_data::path);
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let folders = folders.into_iter().flatten().chain([examples]);
    for path in folders.flat_map(|folder| reference_data::models(&folder)) {
        if path.extension().is_none_or(|extension| extension != "adm") {
            continue;
        }
        let bytes = std::fs::read(&path).expect("the file can be read");
        let before = Source::from_bytes("file", &bytes).expect("the file is text");
        let json = match to_json(&before) {
            Ok(json) => json,
            Err(errors) => {
                let (_, diagnostics) = read_dataset(&before);
                assert!(!diagnostics.is_empty());
                refused.push(format!("{}: {}\n", path.display(), errors[0].message));
                continue;
            }
        };
        let value: Value = serde_json::from_str(&json).expect("JSON is written");
        assert_eq!(schema.check(&value), Ok(()), "{}", path.display());
        let text = dataset_of(&json).unwrap_or_else(|messages| panic!("{messages}"));
        let after = source(&text);
        let meaning = |source: &Source| without_places(&format!("{:?}", read_dataset(source).0));
        assert!(meaning(&before) == meaning(&after), "{}", path.display());
        assert_eq!(to_json(&after).as_ref(), Ok(&json), "{}", path.display());
        let laid_out = dataset::format(&after, Language::Dataset);
        assert_eq!(laid_out.as_ref(), Ok(&text));
        files += 1;
    }
    println!("{files} models; not converted:\n{}", refused.concat());
}

const MODEL: &str = r#"{
  "format": "stiction-model",
  "version": 1,
  "statements": [
    {"statement": "PART", "id": 1, "GROUND": true},
    {"statement": "MARKER", "id": 1, "PART": 1, "QP": [0, 0, 0]}
  ]
}"#;

#[test]
fn what_is_wrong_is_marked_in_the_json() {
    assert_eq!(
        dataset_of(MODEL).as_deref(),
        Ok("\n!\nPART/1\n, GROUND\n!\nMARKER/1\n, PART = 1\n, QP = 0, 0, 0\n!\nEND\n")
    );
    for (old, new, marked, expected) in [
        (
            "\"GROUND\"",
            "\"GRUND\"",
            "\"GRUND\"",
            "PART has no argument GRUND",
        ),
        (
            "\"PART\", \"id\"",
            "\"PRAT\", \"id\"",
            "\"PRAT\"",
            "no statement is called \"PRAT\"",
        ),
        (
            "true",
            "false",
            "false",
            "expected true (leave it out for false), found false",
        ),
        (
            "[0, 0, 0]",
            "[0, 0]",
            "[0, 0]",
            "expected 3 numbers, found 2",
        ),
        (
            "[0, 0, 0]",
            "[0, \"a\", 0]",
            "\"a\"",
            "expected a number, or",
        ),
        (
            "[0, 0, 0]",
            "[0, 1e999, 0]",
            "1e999",
            "this is too large for a number",
        ),
        (
            "[0, 0, 0]",
            "{\"degrees\": 1}",
            "{\"degrees\": 1}",
            "expected a list, found an object",
        ),
        (
            "\"PART\": 1",
            "\"PART\": 0",
            "0",
            "expected a whole number, 1 or greater, found 0",
        ),
        (
            "\"PART\": 1",
            "\"PART\": 1, \"PART\": 2",
            "\"PART\"",
            "\"PART\" is given twice",
        ),
        (
            "\"id\": 1, \"G",
            "\"G",
            "{\"statement\": \"PART\", \"GROUND\": true}",
            "PART needs an id",
        ),
        (
            "\"version\": 1",
            "\"version\": 2",
            "2",
            "this version is not read, but 1",
        ),
        (
            "stiction-model",
            "other",
            "",
            "this is no model in the JSON form of stiction",
        ),
        ("0]}", "0]", "", "this is no model in JSON"),
        (
            "\"GROUND\": true",
            "\"MATERIAL\": \"\\ud800\"",
            "\"\\ud800\"",
            "unexpected end of hex escape",
        ),
        (
            "\"GROUND\": true",
            "\"name\": \"a\\nb\"",
            "\"a\\nb\"",
            "expected a string of one line",
        ),
        (
            "\"GROUND\": true",
            "\"MATERIAL\": \"a\\nb\"",
            "\"a\\nb\"",
            "cannot hold MATERIAL",
        ),
    ] {
        assert!(MODEL.contains(old), "{old}");
        let source = source(&MODEL.replacen(old, new, 1));
        let errors = from_json(&source).unwrap_err();
        let messages: String = errors.iter().map(|error| error.render(&source)).collect();
        println!("{messages}");
        assert_eq!(source.slice(errors[0].span), marked, "{messages}");
        assert!(errors[0].message.contains(expected), "{messages}");
    }
}

#[test]
fn what_a_dataset_cannot_hold_is_refused_where_it_stands() {
    let model = |arguments: &str| {
        format!(
            "{{\"format\": \"stiction-model\", \"version\": 1, \"statements\": [\n\
             {{\"statement\": \"VARIABLE\", \"id\": 1, {arguments}}}]}}"
        )
    };
    for (arguments, column, expected) in [
        ("\"FUNCTION\": \"1 + \"", 48, "the expression ends here"),
        (
            "\"FUNCTION\": \"TIME ! a comment\"",
            48,
            "cannot hold FUNCTION",
        ),
        (
            "\"FUNCTION\": \"1\\\\ , IC = 2\"",
            48,
            "cannot hold FUNCTION",
        ),
        (
            "\"FUNCTION\": \"1\", \"comments\": [\" adams_view_name='x'\"]",
            1,
            "cannot hold VARIABLE",
        ),
        ("\"text\": \"\\nEND\"", 1, "cannot hold VARIABLE"),
    ] {
        let messages = dataset_of(&model(arguments)).unwrap_err();
        println!("{messages}");
        assert!(
            messages.starts_with(&format!("text:2:{column}: error[")),
            "{messages}"
        );
        assert!(messages.contains(expected), "{messages}");
    }
}

/// Any finite number by its bits: subnormal ones and both zeros too.
fn finite() -> impl Strategy<Value = f64> {
    any::<u64>()
        .prop_map(f64::from_bits)
        .prop_filter("finite", |value| value.is_finite())
}

/// A value that the schema allows.
fn value_of(schema: &Value, definitions: &Value) -> BoxedStrategy<Value> {
    if let Some(reference) = schema["$ref"].as_str() {
        return match reference.rsplit('/').next().unwrap_or_default() {
            "number" => prop_oneof![
                finite().prop_map(|value| json!(value)),
                (-1000..1000_i32).prop_map(|value| json!(value)),
                finite().prop_map(|value| json!({ "degrees": value })),
            ]
            .boxed(),
            "id" => (1..=u32::MAX).prop_map(|value| json!(value)).boxed(),
            "line" => "[ -~]{0,12}"
                .prop_map(|text: String| json!(text.trim_end()))
                .boxed(),
            "raw" => prop_oneof![
                Just(json!(true)),
                "[a-z0-9.]{1,9}".prop_map(|text| json!(text))
            ]
            .boxed(),
            "expression" => expression().prop_map(|text| json!(text)).boxed(),
            other => value_of(&definitions[other], definitions),
        };
    }
    if schema["const"] == json!(true) {
        return Just(json!(true)).boxed();
    }
    if let Some(text) = schema["const"].as_str() {
        return Just(json!(text)).boxed();
    }
    if let Some(ways) = schema["oneOf"].as_array() {
        let ways = ways.iter().map(|way| value_of(way, definitions));
        return proptest::strategy::Union::new(ways).boxed();
    }
    match schema["type"].as_str() {
        Some("integer") => any::<u32>().prop_map(|value| json!(value)).boxed(),
        Some("array") => {
            let least = schema["minItems"].as_u64().unwrap_or(0) as usize;
            let most = schema["maxItems"].as_u64().unwrap_or(least as u64 + 6) as usize;
            let item = value_of(&schema["items"], definitions);
            prop::collection::vec(item, least..=most)
                .prop_map(Value::from)
                .boxed()
        }
        _ => "[A-Z][A-Z0-9_]{0,9}".prop_map(|text| json!(text)).boxed(),
    }
}

/// Expressions of every operator and a few functions, some longer than a line.
fn expression() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        Just("TIME".to_string()),
        Just("DX(12,0,3)".to_string()),
        (0.0..1e9).prop_map(|value: f64| value.to_string()),
        (0..720).prop_map(|value| format!("{value}D")),
    ];
    leaf.prop_recursive(6, 40, 3, |inner| {
        prop_oneof![
            (inner.clone(), "[-+*/]", inner.clone()).prop_map(|(a, b, c)| format!("({a}{b}{c})")),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("{a} - {b}")),
            inner.clone().prop_map(|a| format!("SIN(-{a})**2")),
            (inner.clone(), inner.clone(), inner)
                .prop_map(|(a, b, c)| format!("IF({a}: {b}, 0, {c})")),
        ]
    })
}

/// Arguments of any sort and number that the schema of a statement allows.
fn statement_of(name: String, schema: Value, definitions: Value) -> BoxedStrategy<Value> {
    let mut members = Vec::new();
    for (key, schema) in schema["properties"]
        .as_object()
        .cloned()
        .unwrap_or_default()
    {
        // "text" stands in place of arguments; comments have rules of their own.
        if !["statement", "id", "text", "comments"].contains(&key.as_str()) {
            let value = prop::option::weighted(0.4, value_of(&schema, &definitions));
            members.push(value.prop_map(move |value| value.map(|value| (key.clone(), value))));
        }
    }
    let identified = schema["required"]
        .as_array()
        .is_some_and(|names| names.contains(&json!("id")));
    let text_only = schema["required"]
        .as_array()
        .is_some_and(|names| names.contains(&json!("text")));
    (members, 1..=u32::MAX)
        .prop_map(move |(members, id)| {
            let mut statement: Map<String, Value> = members.into_iter().flatten().collect();
            statement.insert("statement".to_string(), json!(name));
            if identified {
                statement.insert("id".to_string(), json!(id));
            }
            if text_only {
                statement.insert("text".to_string(), json!(", A = 1, B"));
            }
            Value::Object(statement)
        })
        .boxed()
}

#[test]
fn any_statement_of_the_tables_comes_back_the_same() {
    let schema: Value = serde_json::from_str(&json_schema()).expect("the schema is JSON");
    let definitions = schema["$defs"].clone();
    let validator = Schema::new();
    let statements = definitions.as_object().expect("an object").iter();
    let statements: Vec<_> = statements
        .filter(|(_, schema)| !schema["properties"]["statement"].is_null())
        .filter(|(name, _)| !["statement", "unknown"].contains(&name.as_str()))
        .map(|(name, schema)| statement_of(name.clone(), schema.clone(), definitions.clone()))
        .collect();
    let kinds = statements.len();
    let any_statement = proptest::strategy::Union::new(statements);
    let config = ProptestConfig::with_cases(20 * kinds as u32);
    let mut runner =
        TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let result = runner.run(&any_statement, |statement| {
        let model = json!({
            "format": "stiction-model", "version": 1, "title": "any", "statements": [statement],
        });
        prop_assert_eq!(validator.check(&model), Ok(()));
        let text = dataset_of(&model.to_string()).map_err(TestCaseError::fail)?;
        let json = json_of(&text).map_err(TestCaseError::fail)?;
        let back: Value = serde_json::from_str(&json).expect("JSON is written");
        let wanted = without_blanks(&model["statements"]);
        prop_assert_eq!(wanted, without_blanks(&back["statements"]), "{}", text);
        Ok(())
    });
    println!("{kinds} kinds of statements");
    assert!(result.is_ok(), "{}", result.unwrap_err());
}

/// A statement with numbers as bits, and texts without the blanks that breaking a line may add.
fn without_blanks(value: &Value) -> Value {
    match value {
        Value::Number(number) => json!(number.as_f64().unwrap_or(f64::NAN).to_bits()),
        Value::String(text) => json!(text.replace(' ', "")),
        Value::Array(values) => values.iter().map(without_blanks).collect(),
        Value::Object(members) => members
            .iter()
            .map(|(name, value)| (name.clone(), without_blanks(value)))
            .collect::<Map<_, _>>()
            .into(),
        other => other.clone(),
    }
}
