//! The harvester of a spec as a drawing to scale, so that a wrong number is seen.
mod body;
mod words;

use crate::picture::Drawing;
use crate::spec::Spec;

/// Draws the harvester of a spec.
///
/// Every beam, mass and structure given by its modes has a side view of its own; a stop between two of them is drawn where it is struck.
/// The spec need not be solvable: faults that only the solver finds (a patch beyond its beam, a stop inside another) are drawn as they are.
#[must_use]
pub fn drawing(title: &str, spec: &Spec) -> Drawing {
    Drawing { title: title.to_owned(), bodies: body::bodies(spec) }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::picture::Carrier;
    use crate::spec::SpecFile;

    fn paper() -> SpecFile {
        SpecFile::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/impact-harvester-2019/harvester.toml")).unwrap()
    }

    #[test]
    fn a_harvester_has_its_own_lengths() {
        let drawn = drawing("", &paper().spec().unwrap());
        let [body] = drawn.bodies.as_slice() else { panic!("one body: {drawn:?}") };
        let beam = body.beam.as_ref().unwrap();
        assert!(matches!(&body.carrier, Carrier::Mass { label, sprung: true, .. } if label == "table"));
        assert_eq!((beam.length_m, beam.thickness_m), (0.315, 0.98e-3));
        assert_eq!((body.stops[0].place_m, body.stops[0].gap_m, body.stops[0].rides), (Some(0.305), 1e-3, false));
        assert!(beam.patches[0].load.as_ref().unwrap().contains("1 Mohm"), "{:?}", beam.patches);
    }

    #[test]
    fn a_stop_on_the_table_rides_on_it() {
        let mut file = paper();
        file.set("stop.tip.frame", "table").unwrap();
        file.set("stop.tip.side", "negative").unwrap();
        let stop = drawing("", &file.spec().unwrap()).bodies[0].stops[0].clone();
        assert!(stop.rides && !stop.above);
    }
}
