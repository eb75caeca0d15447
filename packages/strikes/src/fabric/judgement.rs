//! Whether a strike can be believed: the finished run is held against bounds, and each verdict says what to change.
//! `docs/reference/fabric-files.md` has the bounds.
//!
//! A run is judged up to the first failure, and what follows by itself: torn shreds whip about then, which carry
//! nothing.

use nalgebra::Vector3;

use super::measure::Sample;
use super::run::{End, Outcome};
use super::scene::Case;
use super::weights;
use crate::weave::cloth::Cloth;
use crate::weave::model::Model;
use toron::host::units::UnitSystem;
use toron::law::parameters::STRESS;
use toron_explicit_host::judgement::{self, Finding};
use toron_explicit_host::lanes::{largest, smallest};
use toron_materials::material::model::Material;
use toron_materials::units::{LENGTH, TIME, unit};
use toron_shared::numbers::number;

/// The striker's radius has to hold so many edges of the elements' faces.
const EDGES: f64 = 4.0;
/// No corner of an element may be further inside out.
const LEAST_JACOBIAN: f64 = -0.5;
/// Longitudinal shear may hold this part of what the laws store.
const LARGEST_SHEAR: f64 = 0.5;
/// With less stiffness against longitudinal shear, in Pa, the middle of a section slides along its yarn.
const LEAST_K_LD: f64 = 1e6;
/// Over a yarn's height: how far the striker may get ahead of the panel.
const DEEPEST: f64 = 0.5;

/// What is measured up to a time: the first failure, or the end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measures {
    /// The largest hourglass energy over the largest internal energy.
    pub hourglass: f64,
    /// The largest energy of longitudinal shear over the largest that the laws store.
    pub shear: f64,
    pub least_scaled_jacobian: f64,
    /// The largest energy in the contact over that of the striker at first.
    pub contact: f64,
    /// How far the striker is ahead of the panel at most.
    pub ahead: f64,
    /// Elements that have collapsed.
    pub collapsed: usize,
    /// Of the striker.
    pub travel: f64,
    /// The part that artificial viscosity has taken of the energy that the blow has given away.
    pub viscosity: f64,
}

impl Measures {
    /// Up to the first failure.
    pub fn to_failure(outcome: &Outcome) -> Measures {
        Measures::to(outcome.failed.unwrap_or(f64::INFINITY), outcome)
    }

    /// Of the whole run.
    pub fn whole(outcome: &Outcome) -> Measures {
        Measures::to(f64::INFINITY, outcome)
    }

    fn to(end: f64, outcome: &Outcome) -> Measures {
        let samples = || outcome.measured.iter().take_while(|sample| sample.time <= end);
        let most = |of: fn(&Sample) -> f64| samples().map(of).fold(0.0, largest);
        let share = |part: f64, whole: f64| if part == 0.0 { 0.0 } else { part / whole };
        let internal = most(|sample| sample.energies.internal);
        let first = outcome.measured.first().map(|sample| sample.energies).unwrap_or_default();
        let start = first.total();
        let viscosity = samples().last().and_then(|last| last.energies.viscosity_share(&first));
        Measures {
            hourglass: share(most(|sample| sample.energies.hourglass), internal),
            shear: share(most(|sample| sample.parts[3]), most(|sample| sample.parts.iter().sum())),
            least_scaled_jacobian: samples().map(|sample| sample.own.least_scaled_jacobian).fold(1.0, smallest),
            contact: share(most(|sample| sample.energies.contact), start),
            ahead: most(|sample| sample.travel - sample.own.deflection),
            collapsed: samples().map(|sample| sample.collapsed).max().unwrap_or(0),
            travel: most(|sample| sample.travel),
            viscosity: viscosity.unwrap_or(0.0),
        }
    }
}

/// What is wrong before the first step.
pub fn before(units: &UnitSystem, case: &Case, panel: &Model) -> Vec<Finding> {
    let mut findings: Vec<Finding> =
        case.materials().flat_map(|material| judgement::units(std::slice::from_ref(material), units)).collect();
    findings.extend(weights::findings(units, case, panel));
    findings.extend(sliding(units, case));
    findings.extend(coarse(units, case, panel));
    findings.extend(of_mesh(units, case));
    findings
}

/// Yarns that the mesh makes too long, and a blow beside the middle of a mesh of others.
fn of_mesh(units: &UnitSystem, case: &Case) -> Vec<Finding> {
    let mut findings: Vec<Finding> =
        case.cloth.crimp().iter().map(|text| Finding::new("crimp", text.clone())).collect();
    if let Cloth::Foreign(foreign) = &*case.cloth {
        let beside = foreign.off_middle(case.striker.aim, &unit(units, LENGTH));
        findings.extend(beside.map(|text| Finding::new("aim", text)));
    }
    findings
}

/// What is wrong with a run that has ended, by what was measured up to the first failure and of the whole;
/// `front_at_rim` is when the transverse wave came to the rim.
pub fn judge(
    units: &UnitSystem,
    case: &Case,
    panel: &Model,
    outcome: &Outcome,
    [measures, whole]: [&Measures; 2],
    front_at_rim: Option<f64>,
) -> Vec<Finding> {
    let mut findings = before(units, case, panel);
    if outcome.end == End::Interrupted {
        findings.push(judgement::interrupted());
        return findings;
    }
    let ended = outcome.failed.unwrap_or(f64::INFINITY);
    let spread = measures.travel >= case.striker.radius || front_at_rim.is_some_and(|time| time <= ended);
    if spread {
        findings.extend(hourglass(case, measures));
        findings.extend(shear(case, measures));
        findings.extend(viscosity(measures));
    } else {
        findings.extend(transient(units, case, measures));
    }
    findings.extend(distorted(
        measures,
        "a finer mesh, a larger k_ld or contact-stiffness, or a failure if the yarns would break",
    ));
    let remedy = format!("a finer mesh, a larger k_ld, or another hourglass than {}", case.control.hourglass);
    findings.extend(judgement::collapsed(measures.collapsed, &remedy));
    findings.extend(judgement::contact(measures.contact, case.striker.stiffness));
    findings.extend(sunk(units, case, measures));
    findings.extend(judgement::balance(outcome.balance.imbalance()));
    let error = judgement::error(outcome.failure.as_deref());
    match outcome.failed {
        Some(time) => {
            let failed = format!("the first failure, at {} {}", number(time), unit(units, TIME));
            let found = error.into_iter().chain(after_failure(case, whole));
            judgement::add_after_failure(&mut findings, &failed, found);
        }
        None => findings.extend(error),
    }
    findings
}

/// What is wrong with what followed the first failure, by bounds that torn yarns know too: the striker is ahead of them,
/// and corners of shreds turn over.
fn after_failure(case: &Case, whole: &Measures) -> Vec<Finding> {
    let folded = distorted(whole, "a finer mesh: shreds of torn yarns fold, and carry what they should not");
    let findings = [viscosity(whole), hourglass(case, whole), folded];
    let contact = judgement::contact(whole.contact, case.striker.stiffness);
    findings.into_iter().chain([contact]).flatten().collect()
}

fn hourglass(case: &Case, measures: &Measures) -> Option<Finding> {
    let remedy = format!("a finer mesh, a larger k_ld, or another hourglass than {}", case.control.hourglass);
    judgement::hourglass(measures.hourglass, &remedy)
}

fn viscosity(measures: &Measures) -> Option<Finding> {
    let remedy = "a finer mesh, and see how far what is left to the striker moves with it";
    judgement::viscosity(measures.viscosity, judgement::LARGEST_VISCOSITY, remedy)
}

/// Yarns in whose sections hardly anything carries shear along the fibres.
fn sliding(units: &UnitSystem, case: &Case) -> Option<Finding> {
    let least = units.from_si(LEAST_K_LD, STRESS);
    let slides = |material: &&Material| material.longitudinal_shear().is_some_and(|k_ld| k_ld < least);
    let names = case.materials().filter(slides).map(|material| {
        let [k_ld, name] = [material.longitudinal_shear().map_or(String::new(), number), material.name().to_string()];
        format!("{k_ld} {} in {name}", unit(units, STRESS))
    });
    let mut names: Vec<String> = names.collect();
    names.dedup();
    (!names.is_empty()).then(|| {
        let text = format!(
            "k_ld is {}, less than {} MPa: the middle of a section slides along its yarn:\n\
             take 5 to 20 MPa for woven yarns",
            names.join(", "),
            1e-6 * LEAST_K_LD
        );
        Finding::new("sliding", text)
    })
}

/// A striker that the mesh cannot tell from a needle: it meets nodes, few of them.
fn coarse(units: &UnitSystem, case: &Case, panel: &Model) -> Option<Finding> {
    let node = |number: u32| Vector3::from(panel.nodes[number as usize]);
    let edges = panel
        .faces
        .iter()
        .flat_map(|face| (0..4).map(|i| (node(face.nodes[i]) - node(face.nodes[(i + 1) % 4])).norm()));
    let longest = edges.fold(0.0, largest);
    let radius = case.striker.radius;
    (EDGES * longest > radius).then(|| {
        let unit = unit(units, LENGTH);
        let text = format!(
            "the striker's radius of {} {unit} is less than {EDGES} edges of the elements' faces, {} {unit} long:\n\
             take a finer mesh, with more elements along and columns",
            number(radius),
            number(longest)
        );
        Finding::new("mesh", text)
    })
}

/// A run that has ended, or broken, while the blow still shakes the mesh where the striker has hit it.
///
/// There is hardly any internal energy then that hourglass modes and shear could be held against: in sound runs they
/// have half of it and more at first.
fn transient(units: &UnitSystem, case: &Case, measures: &Measures) -> Option<Finding> {
    let much = judgement::hourglass(measures.hourglass, "").is_some() || shear(case, measures).is_some();
    much.then(|| {
        let [hourglass, shear] = [measures.hourglass, measures.shear].map(|share| 100.0 * share);
        let unit = unit(units, LENGTH);
        let text = format!(
            "it ended, or an element failed, after {} {unit} of the striker's way, less than its radius, and before the\n\
             transverse wave was at the rim: too early to judge hourglass energy, {hourglass:.0} % of the internal energy, and\n\
             W_ld, {shear:.0} % of it: take a later end, or a finer mesh",
            number(measures.travel)
        );
        Finding::new("transient", text)
    })
}

/// Sections that do little but slide along their yarns.
fn shear(case: &Case, measures: &Measures) -> Option<Finding> {
    let exceeds = measures.shear.is_nan() || measures.shear > LARGEST_SHEAR;
    exceeds.then(|| {
        let k_ld = case.materials().filter_map(|material| material.longitudinal_shear()).fold(0.0, largest);
        let text = format!(
            "W_ld of longitudinal shear is {:.0} % of what the laws store, more than {:.0} %:\n\
             take a finer mesh, or another k_ld than {}",
            100.0 * measures.shear,
            100.0 * LARGEST_SHEAR,
            number(k_ld)
        );
        Finding::new("shear", text)
    })
}

/// Elements whose corners are inside out.
fn distorted(measures: &Measures, remedy: &str) -> Option<Finding> {
    let least = measures.least_scaled_jacobian;
    let below = least.is_nan() || least < LEAST_JACOBIAN;
    below.then(|| {
        let text = format!(
            "an element's corner is inside out, with a scaled Jacobian of {least:.2}, less than {LEAST_JACOBIAN}:\n\
             take {remedy}"
        );
        Finding::new("jacobian", text)
    })
}

/// A striker that goes into the yarns instead of taking them along.
fn sunk(units: &UnitSystem, case: &Case, measures: &Measures) -> Option<Finding> {
    let [_, height] = case.cloth.yarn_heights();
    let exceeds = measures.ahead.is_nan() || measures.ahead > DEEPEST * height;
    exceeds.then(|| {
        let (ahead, unit) = (number(measures.ahead), unit(units, LENGTH));
        let text = format!(
            "the striker is up to {ahead} {unit} ahead of the panel, more than {DEEPEST} of a yarn's height, before a yarn fails:\n\
             take a larger contact-stiffness than {:e}, or a finer mesh",
            case.striker.stiffness
        );
        Finding::new("penetration", text)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fabric::scene::Scene;
    use toron_explicit_host::energies::{Balance, Energies};
    use toron_explicit_host::judgement::verdict;

    /// A run of the coarse example, but for its size.
    const SOUND: Measures = Measures {
        hourglass: 0.0076,
        shear: 0.032,
        least_scaled_jacobian: -0.193,
        contact: 0.0123,
        ahead: 0.0038,
        collapsed: 0,
        travel: 5.404,
        viscosity: 0.02,
    };

    /// The verdict of a panel that a sphere of this radius strikes; the density as a factor, how far the energy is off.
    fn verdict_of(measures: Measures, radius: f64, density: f64, off: f64, front_at_rim: Option<f64>) -> String {
        judged([measures, measures], [radius, density, off], front_at_rim, None)
    }

    /// The verdict by what was measured up to the first failure, at `failed`, and of the whole.
    fn judged(
        [measures, whole]: [Measures; 2],
        [radius, density, off]: [f64; 3],
        front_at_rim: Option<f64>,
        failed: Option<f64>,
    ) -> String {
        let ended = Outcome { failed, ..outcome(off) };
        judged_as([measures, whole], [radius, density], front_at_rim, ended)
    }

    /// A run whose energy is off by so much.
    fn outcome(off: f64) -> Outcome {
        let mut balance = Balance::default();
        for striker in [1.0, 1.0 - off] {
            balance.add(&Energies { striker, ..Energies::default() });
        }
        Outcome {
            measured: Vec::new(),
            balance,
            history: Vec::new(),
            snapshots: Vec::new(),
            end: End::Time,
            course: Default::default(),
            decision: None,
            limited: [0.0; 5],
            histogram: Default::default(),
            lent: 0.0,
            failed: None,
            failure: None,
            elements: 1,
            cost: Default::default(),
            searches: 0,
            wall: Default::default(),
        }
    }

    fn judged_as(
        [measures, whole]: [Measures; 2],
        [radius, density]: [f64; 2],
        front_at_rim: Option<f64>,
        outcome: Outcome,
    ) -> String {
        let density = 1.3514e-3 * density;
        let text = format!(
            "units = \"mm-g-ms\"\n[weave]\npreset = \"kevlar-s706\"\nalong = 4\ncolumns = 4\n\
             [weave.panel]\nshape = \"circle\"\nradius = 3.0\npart = \"quarter\"\n\
             [scene]\nspeed = 1.0\nstriker-density = 7.8e-3\nradius = {radius}\ncontact-stiffness = 1e5\nend = 1.0\n\
             hyperelastic.density = {density}\nhyperelastic.properties = {{ k_ld = 126.0 }}\n"
        );
        let scene = Scene::parse("patch.toml", &text).expect("a scene");
        let (case, panel) = (&scene.cases[0], scene.cases[0].cloth.model());
        verdict(&judge(&scene.units, case, &panel, &outcome, [&measures, &whole], front_at_rim))
    }

    /// The cloth knows it: no run, and no shot, solves the finer weaves again by which a mesh is judged.
    #[test]
    fn what_is_said_of_crimp_comes_with_the_cloth() {
        let weave = "units = \"mm-g-ms\"\n[weave]\npattern = \"plain\"\nwarp = { pitch = 1.18, width = 0.95, height = 0.128 }\n";
        let scene = |along: usize| {
            let text = format!(
                "{weave}along = {along}\ncolumns = {along}\n[weave.panel]\nshape = \"circle\"\nradius = 2.0\n\
                 [scene]\nspeed = 1.0\nstriker-density = 7.8e-3\nradius = 3.0\ncontact-stiffness = 1e5\nend = 1.0\n"
            );
            let mut scene = Scene::parse("tutorial.toml", &text).expect("a scene");
            (scene.units, scene.cases.remove(0))
        };
        for (along, wanted) in [(4, true), (8, false)] {
            let (units, mut case) = scene(along);
            assert_eq!(verdict(&of_mesh(&units, &case)) == "crimp", wanted, "{along}");
            let Cloth::Woven(layup) = std::sync::Arc::make_mut(&mut case.cloth) else { panic!("a weave") };
            layup.crimp = vec!["as it is known".to_string()];
            let said: Vec<String> = of_mesh(&units, &case).into_iter().map(|finding| finding.text).collect();
            assert_eq!(said, ["as it is known"]);
        }
    }

    /// Units are those of the scene; a linear law carries shear along the fibres anyway.
    #[test]
    fn yarns_that_slide_are_in_the_verdict() {
        let found = |weave: &str, materials: &str| {
            let text = format!(
                "units = \"mm-g-ms\"\n[weave]\npreset = \"kevlar-s706\"\nalong = 4\ncolumns = 4\n{weave}\n\
                 [weave.panel]\nshape = \"circle\"\nradius = 3.0\npart = \"quarter\"\n\
                 [scene]\nspeed = 1.0\nstriker-density = 7.8e-3\nradius = 2.778\ncontact-stiffness = 1e5\nend = 1.0\n{materials}\n"
            );
            let scene = Scene::parse("patch.toml", &text).expect("a scene");
            sliding(&scene.units, &scene.cases[0]).map(|finding| finding.text).unwrap_or_default()
        };
        let zero = "k_ld is 0 MPa in kevlar-km2-600, less than 1 MPa: the middle of a section slides along its yarn:\n  \
                    take 5 to 20 MPa for woven yarns";
        let held = "hyperelastic.properties = { k_ld = 5.0 }";
        let weft = |k_ld: f64| format!("weft.material = {{ properties = {{ k_ld = {k_ld:?} }} }}");
        let [soft, stiff] = [0.5, 5.0].map(weft);
        for (weave, materials, wanted) in [
            ("", "", zero),
            ("", "law = \"hybrid\"\nhyperelastic-radius = 1.0", zero),
            ("", held, ""),
            ("", "law = \"linear-elastic\"", ""),
            (&*soft, held, "k_ld is 0.5000 MPa in kevlar-km2-600"),
            (&*stiff, held, ""),
        ] {
            let said = found(weave, materials);
            assert!(said.starts_with(wanted) && said.is_empty() == wanted.is_empty(), "{weave} {materials}: {said}");
        }
    }

    #[test]
    fn each_bound_has_its_verdict() {
        let of = |measures: Measures| verdict_of(measures, 2.778, 1.0, 1e-5, None);
        assert_eq!(of(SOUND), "sound");
        for (measures, verdict) in [
            (Measures { hourglass: 0.11, ..SOUND }, "hourglass"),
            (Measures { hourglass: f64::NAN, ..SOUND }, "hourglass"),
            (Measures { shear: 0.51, ..SOUND }, "shear"),
            (Measures { least_scaled_jacobian: -0.51, ..SOUND }, "jacobian"),
            (Measures { least_scaled_jacobian: f64::NAN, ..SOUND }, "jacobian"),
            (Measures { contact: 0.051, ..SOUND }, "contact"),
            (Measures { viscosity: 0.11, ..SOUND }, "viscosity"),
            (Measures { ahead: 0.058, ..SOUND }, "penetration"),
            (Measures { collapsed: 1, ..SOUND }, "collapsed"),
            (
                Measures { hourglass: 1.5, least_scaled_jacobian: -0.997, shear: 0.9, ..SOUND },
                "hourglass; shear; jacobian",
            ),
        ] {
            assert_eq!(of(measures), verdict, "{measures:?}");
        }
        assert_eq!(verdict_of(SOUND, 2.778, 1.0, 0.011, None), "balance");
        assert_eq!(verdict_of(SOUND, 0.7, 1.0, 1e-5, None), "mesh");
        // Of the wave, and of the panel's weight.
        assert_eq!(verdict_of(SOUND, 2.778, 1000.0, 1e-5, None), "units");
        assert_eq!(verdict_of(SOUND, 2.778, 1e-3, 1e-5, None), "units");
    }

    /// What follows the first failure is judged by itself; what was wrong before it is not said twice.
    #[test]
    fn what_follows_a_failure_is_in_the_verdict() {
        let of = |measures, whole, failed| judged([measures, whole], [2.778, 1.0, 1e-5], None, failed);
        let shreds = Measures { viscosity: 0.32, least_scaled_jacobian: -0.96, ahead: 3.0, collapsed: 9, ..SOUND };
        assert_eq!(of(SOUND, shreds, Some(0.03)), "sound to failure; then viscosity; jacobian");
        assert_eq!(of(SOUND, SOUND, Some(0.03)), "sound");
        let before = Measures { least_scaled_jacobian: -0.6, ..SOUND };
        assert_eq!(of(before, shreds, Some(0.03)), "jacobian to failure; then viscosity");
        let wild = Measures { hourglass: 0.2, contact: f64::NAN, ..SOUND };
        assert_eq!(of(SOUND, wild, Some(0.03)), "sound to failure; then hourglass; contact");
    }

    /// Nothing else need be wrong with what was measured until then.
    #[test]
    fn a_run_that_could_not_go_on_is_not_sound() {
        let of = |failed: Option<f64>| {
            let ended = Outcome { end: End::Failed, failure: Some("no step".to_string()), failed, ..outcome(1e-5) };
            judged_as([SOUND; 2], [2.778, 1.0], None, ended)
        };
        assert_eq!([of(None), of(Some(0.03))], ["error", "sound to failure; then error"]);
    }

    #[test]
    fn the_blow_s_own_waves_are_no_measure_and_are_not_passed_over() {
        let early = |hourglass: f64| Measures { hourglass, shear: 0.6, travel: 1.0, ..SOUND };
        assert_eq!(verdict_of(early(0.2), 2.778, 1.0, 1e-5, None), "transient");
        assert_eq!(verdict_of(early(0.2), 2.778, 1.0, 1e-5, Some(0.1)), "hourglass; shear");
        assert_eq!(verdict_of(Measures { travel: 1.0, ..SOUND }, 2.778, 1.0, 1e-5, None), "sound");
    }
}
