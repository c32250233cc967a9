//! Scale drawing of the harvester of a spec.
mod bodies;
mod circuits;
mod plans;
mod words;

use crate::{Drawing, DrawnContact, DrawnDrive};
use jounce_spec::{Side, Spec, Stop};

/// Draws the harvester of a spec.
///
/// Bodies that strike each other are drawn opposite each other, and circuits apart from the bodies.
/// The spec need not be solvable: errors that only the solver finds (a patch beyond its beam, a
/// stop inside another) are drawn as they are.
#[must_use]
pub fn drawing(title: &str, spec: &Spec) -> Drawing {
    let index = bodies::Index::of(spec);
    let contact = |name: &String, stop: &Stop| {
        Some(DrawnContact {
            label: words::on_base(spec, vec![name.clone()], &stop.frame).join(" "),
            at: index.position_of(spec, &stop.at)?,
            on: index.position_of(spec, &stop.frame),
            above: stop.side == Side::Positive,
            gap_m: stop.gap_m,
            law: words::law(stop),
        })
    };
    let contacts: Vec<(&str, DrawnContact)> = spec
        .stop
        .iter()
        .filter_map(|(name, stop)| Some((name.as_str(), contact(name, stop)?)))
        .collect();
    let drives = spec.drive.iter().map(|(name, drive)| DrawnDrive {
        words: words::drive(name, drive),
        at: index.position_of(spec, &drive.at),
        base: drive.base().map(str::to_owned),
        carried_bodies: drive
            .base()
            .map_or_else(Vec::new, |base| index.on_base(spec, base)),
        stops: drive.base().map_or_else(Vec::new, |base| {
            bodies::Index::stops_on(spec, &contacts, base)
        }),
    });
    let drives = drives.collect();
    Drawing {
        title: title.to_owned(),
        bodies: bodies::bodies(spec, &index),
        contacts: contacts.into_iter().map(|(_, contact)| contact).collect(),
        drives,
        gravity: words::gravity(&spec.gravity),
        circuits: circuits::circuits(spec),
        plans: plans::plans(spec),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::{DrawnElement, DrawnShape, Seat};
    use jounce_spec::SpecFile;

    fn example(name: &str) -> SpecFile {
        SpecFile::read(format!(
            "{}/../../examples/{name}/harvester.toml",
            env!("CARGO_MANIFEST_DIR")
        ))
        .unwrap()
    }

    fn load_drawing(name: &str) -> Drawing {
        drawing("", &example(name).spec().unwrap())
    }

    #[test]
    fn a_harvester_has_its_own_lengths() {
        let drawing_of = load_drawing("impact-harvester-2019");
        let [table, beam] = drawing_of.bodies.as_slice() else {
            panic!("two bodies: {drawing_of:?}")
        };
        let DrawnShape::Beam(shape) = &beam.shape else {
            panic!("{beam:?}")
        };
        assert_eq!(
            (table.seat, &table.shape),
            (Seat::Spring(None), &DrawnShape::Block)
        );
        assert!(matches!(beam.seat, Seat::On(place) if place.body == 0));
        assert_eq!(
            (shape.length_m, shape.thickness_m, shape.patches[0].top),
            (0.315, 0.98e-3, true)
        );
        let stop = &drawing_of.contacts[0];
        assert_eq!((stop.at.along_m, stop.gap_m, stop.on), (0.305, 1e-3, None));
        assert!(
            drawing_of.circuits[0]
                .elements
                .contains(&DrawnElement::Resistor(vec!["1 MΩ".into()])),
            "{:?}",
            drawing_of.circuits
        );
    }

    #[test]
    fn the_label_of_a_stop_has_the_computed_stiffness_and_the_bodies() {
        let mut file = example("impact-harvester-2019");
        for (key, value) in [
            ("radius", "5 mm"),
            ("material", "steel"),
            ("stop_youngs_modulus", "110 GPa"),
            ("stop_poisson_ratio", "0.35"),
        ] {
            file.set(&format!("stop.tip.{key}"), value).unwrap();
        }
        let label = |file: &SpecFile| {
            let drawing = drawing("", &file.spec().unwrap());
            drawing.contacts[0].law.clone()
        };
        assert_eq!(
            label(&file),
            "hertz, 7.5084e9 N/m^1.5: steel R 5 mm on 110 GPa"
        );
        let table = "{ at = \"beam.tip\", gap = \"1 mm\", law = \"table\", penetration_m = [1e-4, 3e-4], force_n = [1, 5], damping = \"0.2 s/m\" }";
        file.set("stop.tip", table).unwrap();
        assert_eq!(label(&file), "table, 2 points, 5 N at 300 µm, 0.2 s/m");
    }

    #[test]
    fn a_stop_on_the_table_rides_on_it() {
        let mut file = example("impact-harvester-2019");
        file.set("stop.tip.frame", "table").unwrap();
        file.set("stop.tip.side", "negative").unwrap();
        let stop = drawing("", &file.spec().unwrap()).contacts[0].clone();
        assert!(stop.on.is_some_and(|on| on.body == 0) && !stop.above);
    }

    /// A bond line under the patch raises the patch by its thickness, and the stop begins above
    /// both.
    #[test]
    fn a_layer_lies_between_the_beam_and_its_patch() {
        let path = format!(
            "{}/../../examples/impact-harvester-2019/harvester.toml",
            env!("CARGO_MANIFEST_DIR")
        );
        let bond = "[layer.bond]\non = \"beam\"\nstart = \"9 mm\"\nlength = \"85 mm\"\nwidth = \"30 mm\"\nthickness = \"2 mm\"\n\
            youngs_modulus = \"3 GPa\"\nsection = \"thin-skin\"\n";
        let file = SpecFile::from_text(format!(
            "{}\n{bond}",
            std::fs::read_to_string(path).unwrap()
        ));
        let svg = drawing("", &file.spec().unwrap()).to_svg();
        let edges = |class: &str| {
            let element = svg
                .split("<rect")
                .find(|element| element.contains(class))
                .unwrap_or_else(|| panic!("{svg}"));
            let number = |name: &str| {
                element
                    .split(&format!(" {name}=\""))
                    .nth(1)
                    .unwrap()
                    .split('"')
                    .next()
                    .unwrap()
                    .parse::<f64>()
                    .unwrap()
            };
            (number("y"), number("y") + number("height"))
        };
        let (beam, bond, patch) = (
            edges("jounce-beam"),
            edges("jounce-layer"),
            edges("jounce-patch"),
        );
        assert!(
            (bond.1 - beam.0).abs() < 0.02 && (patch.1 - bond.0).abs() < 0.02,
            "{beam:?} {bond:?} {patch:?}"
        );
        assert!(svg.contains("bond: 85 × 30 ×"), "{svg}");
    }

    /// An open patch is marked on the beam and next to the circuits. A body on a moving base has an
    /// arrow, a fixed body has no arrow.
    #[test]
    fn open_patches_and_moving_bases_are_marked() {
        let path = format!(
            "{}/../../examples/impact-harvester-2019/harvester.toml",
            env!("CARGO_MANIFEST_DIR")
        );
        let text = std::fs::read_to_string(path).unwrap();
        let mut spec = Spec::from_toml(&text).unwrap();
        assert!(!drawing("", &spec).to_svg().contains("open"));
        spec.open_circuits();
        let drawing_of = drawing("", &spec);
        let DrawnShape::Beam(beam) = &drawing_of.bodies[1].shape else {
            panic!("{drawing_of:?}")
        };
        assert_eq!(
            (
                beam.patches[0].label.as_str(),
                drawing_of.circuits[0].label.as_str()
            ),
            ("mfc (open)", "none: open")
        );
        assert!(
            drawing_of.to_svg().contains("mfc (open): ")
                && drawing_of.to_svg().contains("circuit none: open")
        );
        let moving = "[mass.one]\non = \"head\"\nmass = \"1 kg\"\nfrequency = \"1 Hz\"\ndamping_ratio = 0.1\n\
            [mass.two]\nmass = \"1 kg\"\nfrequency = \"1 Hz\"\ndamping_ratio = 0.1\n\
            [drive.d]\nkind = \"base-displacement\"\nat = \"head\"\namplitude = \"1 mm\"\nfrequency = \"9 Hz\"\n";
        let drawing_of = drawing("", &Spec::from_toml(moving).unwrap());
        assert_eq!(
            (
                &drawing_of.drives[0].carried_bodies[..],
                drawing_of.bodies[0].words.last().unwrap().as_str()
            ),
            (&[0][..], "on head")
        );
        assert_eq!(
            drawing_of.to_svg().matches("d of head: 1 mm peak").count(),
            1
        );
    }

    #[test]
    fn both_faces_and_their_circuit_are_drawn() {
        let drawing_of = load_drawing("bimorph-erturk-2009");
        let shape = drawing_of
            .bodies
            .iter()
            .find_map(|body| {
                if let DrawnShape::Beam(beam) = &body.shape {
                    Some(beam)
                } else {
                    None
                }
            })
            .unwrap();
        assert_eq!(shape.patches.iter().filter(|patch| patch.top).count(), 1);
        let series = DrawnElement::Patches(vec![("top".into(), false), ("bottom".into(), true)]);
        assert_eq!(drawing_of.circuits[0].elements[0], series);
    }

    /// A plate is a symbol in the side view and to scale in its plan view, where a stop, a mass and a
    /// patch are at their places.
    #[test]
    fn a_plate_has_a_plan_view() {
        let lump = "[mass.lump]\non = \"plate.corner\"\nmass = \"1 g\"\n";
        let starter = jounce_spec::starter::Starter::of("plate-with-stop").unwrap();
        let text = format!("{}\n{lump}", starter.spec);
        let drawing_of = drawing("", &Spec::from_toml(&text).unwrap());
        let plan = &drawing_of.plans[0];
        assert_eq!(plan.points[0].label, "corner: mass lump, stop corner_stop");
        assert_eq!(plan.edges[0], crate::DrawnEdge::Clamped);
        let svg = drawing_of.to_svg();
        let patch = svg
            .rsplit("<rect")
            .find(|element| element.contains("jounce-patch"))
            .unwrap();
        let number = |name: &str| {
            let text = patch.split(&format!(" {name}=\"")).nth(1).unwrap();
            text.split('"').next().unwrap().parse::<f64>().unwrap()
        };
        assert!(
            (number("width") / number("height") - 40.0 / 60.0).abs() < 1e-3,
            "{patch}"
        );
        for words in [
            "plate, aluminium, seen from above",
            ">patch<",
            "corner: mass lump",
            "plan view",
        ] {
            assert!(svg.contains(words), "{words}: {svg}");
        }
    }
}
