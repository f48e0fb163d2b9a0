//! What a scene may say, and what is understood.

use super::{BOUNDARY, NAMED, SPATIAL, SQUARE, parse};
use billiards_cli::document::Source;
use billiards_cli::scene::{
    Border, Curve, Domain, EdgePath, IfAbsent, LAWS, LawKind, Limit, Request, Sample, Scene, Starts, TABLES,
    TableShape, Turn,
};

#[test]
fn a_named_table_and_an_orbit_are_read() {
    let scene = parse(NAMED).unwrap();
    assert_eq!(scene.title.as_deref(), Some("No-slip stadium"));
    assert_eq!((scene.dimension, scene.law.kind), (2, LawKind::NoSlip));
    let TableShape::Named { model, arguments, .. } = &scene.table.shape else { panic!() };
    assert_eq!((model.name, arguments.number("radius"), arguments.number("half_length")), ("stadium", 1.0, 1.0));
    assert_eq!((scene.particle.radius.value, scene.particle.gamma_squared.value), (0.0, 0.5));
    let Starts::Orbits(orbits) = &scene.starts else { panic!() };
    assert_eq!(orbits[0].position.value, [0.1, 2f64.sqrt() / 4.0]);
    assert_eq!((&orbits[0].velocity.value[..], &orbits[0].spin.value[..]), (&[0.6, 0.8][..], &[0.25][..]));
    assert!(matches!(scene.limit, Some(Limit::Collisions(n)) if n.value == 1000));
    assert_eq!(scene.output.collisions.map(|format| format.name), Some("csv"));
    assert_eq!(scene.output.pictures.iter().map(|p| p.0).collect::<Vec<_>>(), ["orbit", "velocity-portrait"]);
}

#[test]
fn values_remember_where_they_stand() {
    let scene = parse(NAMED).unwrap();
    let Starts::Orbits(orbits) = &scene.starts else { panic!() };
    let place = scene.source.diagnostic(orbits[0].position.span, "outside the table").place().unwrap();
    assert_eq!((place.line, place.column), (15, 12));
    assert_eq!(scene.source.slice(orbits[0].velocity.span), "[0.6, 0.8]");
}

#[test]
fn every_kind_of_boundary_entry_is_read() {
    let scene = parse(BOUNDARY).unwrap();
    let TableShape::Boundary(entries) = &scene.table.shape else { panic!() };
    assert_eq!((entries.len(), scene.table.lattice.len()), (9, 2));
    let Border::Loop { edges, .. } = &entries[0].border else { panic!() };
    let EdgePath::Arc { turn, .. } = edges[1].path else { panic!() };
    assert_eq!(turn, Turn::CounterClockwise);
    assert_eq!(edges[2].law.as_ref().unwrap().kind, LawKind::Specular);
    assert_eq!(entries[5].law.as_ref().unwrap().kind, LawKind::Restitution { normal: 0.9, tangential: 0.0 });
    let Border::Curve { curve: Curve::Polar { radius, .. }, domain: Domain::Inside, .. } = &entries[5].border else {
        panic!()
    };
    assert_eq!(radius.evaluate(&[0.0]), 1.2);
    let Border::Curve { curve: Curve::Implicit { function, within }, domain: Domain::Outside, .. } = &entries[6].border
    else {
        panic!()
    };
    assert_eq!((function.evaluate(&[2.0, 1.0]), within.value), (1.0, [[-3.0, -2.0], [3.0, 2.0]]));
    let Border::Shape { lengths, domain: Domain::Outside, .. } = &entries[7].border else { panic!() };
    assert!(lengths.contains(&0.1), "{lengths:?}");
    let Starts::Ensemble(ensemble) = &scene.starts else { panic!() };
    assert_eq!((ensemble.count.value, ensemble.seed, ensemble.sample.value), (100_000, u64::MAX, Sample::Canonical));
    assert!(matches!(scene.limit, Some(Limit::Time(t)) if t.value == 250.0));
}

#[test]
fn a_scene_in_space_is_read() {
    let scene = parse(SPATIAL).unwrap();
    assert_eq!((scene.dimension, scene.law.kind), (3, LawKind::Rough(vec![vec![1.0, 2.0, -3.0]])));
    assert_eq!(scene.particle.gamma_squared.value, 0.4);
    assert_eq!(scene.table.laws[1].law, LawKind::Random { rank: 1, seed: 0 });
    let Starts::Orbits(orbits) = &scene.starts else { panic!() };
    assert_eq!(orbits[0].spin.value, [0.0, 0.25, 0.0]);
}

#[test]
fn every_law_is_read_as_itself_from_its_example() {
    for law in LAWS {
        let text = SPATIAL.replacen("rough = [[1, 2, -3]]", law.example, 1);
        let scene = parse(&text).unwrap_or_else(|e| panic!("{}: {e:?}", law.name));
        let said = scene.law.kind.to_string();
        assert_eq!(said.split(' ').next(), Some(law.name), "{said}");
    }
}

#[test]
fn every_built_in_table_is_read_with_its_required_parameters_alone() {
    for model in TABLES.iter() {
        let required = model.parameters.iter().filter_map(|parameter| match parameter.default {
            IfAbsent::Required(Some(example)) => Some(format!("{} = {example}", parameter.name)),
            IfAbsent::Required(None) => Some(format!("{} = \"pi/3\"", parameter.name)),
            IfAbsent::Value(_) => None,
        });
        let extra: Vec<_> = required.collect();
        let extra = extra.join(", ");
        let (n, zeros) = (model.dimension, ["0"].repeat(model.dimension).join(", "));
        let text = format!(
            "law = \"specular\"\ntable = {{ dimension = {n}, name = \"{}\", {extra} }}\n\
             orbit = [{{ position = [{zeros}], velocity = [{}] }}]\nrun = {{ time = 1 }}",
            model.name,
            zeros.replacen('0', "1", 1)
        );
        parse(&text).unwrap_or_else(|e| panic!("{}: {e:?}", model.name));
    }
}

#[test]
fn the_command_line_takes_the_place_of_law_and_limit() {
    let bare = NAMED.replace("law   = \"no-slip\"", "").replace("[run]\ncollisions = 1000", "");
    let source = Source::new("x.toml", &bare);
    assert_eq!(Scene::parse(&source, &Request::default()).unwrap_err().len(), 2);
    let request = Request { law: Some(LawKind::Specular), collisions: Some(7), needs_limit: true };
    let scene = Scene::parse(&source, &request).unwrap();
    assert_eq!(scene.law.kind, LawKind::Specular);
    assert!(matches!(scene.limit, Some(Limit::Collisions(n)) if n.value == 7));
    let request = Request { law: Some(LawKind::Specular), ..Request { needs_limit: false, ..Request::default() } };
    assert!(Scene::parse(&source, &request).unwrap().limit.is_none());
    let replaced = Request { collisions: Some(7), ..Request::default() };
    let scene = Scene::parse(&Source::new("x.toml", NAMED), &replaced).unwrap();
    assert!(matches!(scene.limit, Some(Limit::Collisions(n)) if n.value == 7));
}

#[test]
fn a_seed_may_be_a_text_like_all_numbers() {
    for (seed, expected) in [("\"18446744073709551615\"", u64::MAX), ("\"2^10\"", 1024), ("1e3", 1000), ("0", 0)] {
        let text = BOUNDARY.replace("seed = 18446744073709551615", &format!("seed = {seed}"));
        let scene = Scene::parse(&Source::new("x.toml", &text), &Request::default()).unwrap();
        let Starts::Ensemble(ensemble) = &scene.starts else { panic!("an ensemble") };
        assert_eq!(ensemble.seed, expected, "{seed}");
    }
}

#[test]
fn a_section_without_keys_is_as_good_as_none() {
    let scene = format!("{}[run]\n[output]\n", SQUARE.replace("run = { collisions = 1 }\n", ""));
    let parse = |needs_limit, collisions| {
        Scene::parse(&Source::new("x.toml", &scene), &Request { needs_limit, collisions, ..Request::default() })
    };
    assert_eq!(parse(false, None).unwrap().limit, None);
    assert!(parse(true, Some(5)).unwrap().limit.is_some());
    let errors = parse(true, None).unwrap_err();
    assert_eq!(errors[0].what, "[run] needs \"collisions\" or \"time\"");
}
