//! Struck yarns and panels of a law of one's own, against the library's laws where they have the same formulas, and
//! against the balance of energy.

use reinforced_solid::ReinforcedSolid;
use reinforced_solid::viscoelastic::ViscoelasticSolid;
use toron::host::Material;
use toron::host::prepared::AsNumbers;
use toron::user::parameters::{NUMBER, Property, STRESS, component, positive};
use toron::user::state::{ALIVE, ENERGY_DENSITY, FAILED, StateVariable, variable};
use toron::user::vector::{along, dot, image, scale};
use toron::user::{Description, Direction, Reads, Real, Resistance, Response, Step, UserMaterial};
use toron_explicit_host::energies::Balance;
use toron_explicit_host::struck;
use toron_explicit_host::struck::run::Struck;
use toron_materials::material::laws::Laws;
use toron_materials::material::own_law::OwnLaw;
use toron_strikes::fabric;
use toron_strikes::impact::outcome::Outcome;
use toron_strikes::impact::run::{self, StruckYarn};
use toron_strikes::impact::scene::Scene;

/// The law M as a program of its own has it.
fn laws<M>(symbol: &'static str) -> Laws
where
    M: Material<f64> + Material<f32>,
    <M as Material<f64>>::Law: AsNumbers<f64> + Send + Sync + 'static,
    <M as Material<f32>>::Law: AsNumbers<f32> + Send + Sync + 'static,
{
    Laws::Own(Box::leak(Box::new(OwnLaw::new::<M>(symbol, 9).expect("a name and a number"))))
}

/// Half a yarn of 60 elements struck in its middle, with these keys and this material's table.
fn scene_text(keys: &str, material: &str) -> String {
    format!(
        "units = \"mm-g-ms\"\n[scene]\nhalf-length = 6.0\nheight = 0.115\nwidth = 0.5337\nlayers = 20\nrows = 1\n\
         columns = 3\nmass = 9.91e-3\nradius = 1.1\nfriction = 0.18\ncontact-stiffness = 1e6\n{keys}\n{material}"
    )
}

fn strike(laws: Laws, text: &str) -> Outcome {
    let scene = Scene::parse_with(laws, "yarn.toml", text).unwrap_or_else(|error| panic!("{error}"));
    run::run(&scene.cases[0], &mut ()).unwrap_or_else(|error| panic!("{error}"))
}

/// Why the scene cannot be run.
fn refused(laws: Laws, text: &str) -> String {
    let scene = match Scene::parse_with(laws, "yarn.toml", text) {
        Ok(scene) => scene,
        Err(error) => return error.to_string(),
    };
    StruckYarn::new(&scene.cases[0]).map(|_| ()).expect_err("it is refused").to_string()
}

const KEVLAR: &str =
    "k_el = 82341.0\nk_tc = 1055.0\np = 2.2\nk_td = 649.74\neps_lim = 0.0458\nalpha = 1.8\nbeta = 0.0\n";

/// The library's law behind the interface of one's own has the same bits in every sample, up to the break and behind
/// it, since the kernels, the bound of the step, viscosity and hourglass control are the same.
#[test]
fn the_library_s_law_as_one_s_own_has_the_same_bits() {
    let keys = "speed = 130.0\nend = 0.03\n";
    for precision in ["", "precision = \"f32\"\n"] {
        let own = strike(
            laws::<toron::Hyperelastic>("YARN"),
            &scene_text(
                &format!("{keys}{precision}"),
                &format!("[scene.material]\ndensity = 1.3514e-3\n[scene.material.properties]\n{KEVLAR}"),
            ),
        );
        let library = strike(
            Laws::Toron,
            &scene_text(
                &format!("{keys}{precision}failure = \"multiaxial\"\n"),
                &format!(
                    "[scene.hyperelastic]\nlaw = \"hyperelastic\"\ndensity = 1.3514e-3\n[scene.hyperelastic.properties]\n{KEVLAR}"
                ),
            ),
        );
        assert!(library.failed.is_some() && library.cost.steps > 300, "{:?} {}", library.failed, library.cost.steps);
        assert_eq!((own.failed, own.cost.steps, own.end), (library.failed, library.cost.steps, library.end));
        assert_eq!(own.history.len(), library.history.len());
        for (own, library) in own.history.iter().zip(&library.history) {
            assert_eq!((own.time, own.speed, own.deleted), (library.time, library.speed, library.deleted));
            assert_eq!(own.own.widths, library.own.widths);
            // The four modes' energies are summed in another order.
            let [sum, whole] = [own.energies.internal, library.energies.internal];
            assert!((sum - whole).abs() <= 1e-6 * whole.abs(), "{sum} {whole}");
        }
    }
}

/// The yarn law with the exponent 2 and without longitudinal shear, in one's own words.
#[derive(Clone, Copy, Debug, Default)]
struct FormulaYarn;

static PROPERTIES: [Property; 6] = [
    positive("k_el", "k_el", STRESS, None, "elongation stiffness"),
    positive("k_tc", "k_tc", STRESS, None, "compaction stiffness"),
    positive("k_td", "k_td", STRESS, None, "distortion stiffness"),
    component("m_1", "m1", 1.0, "fibre direction"),
    component("m_2", "m2", 0.0, "fibre direction"),
    component("m_3", "m3", 0.0, "fibre direction"),
];

static STATE: [StateVariable; 6] = [
    variable("w_el", "w_el", ENERGY_DENSITY, "energy of elongation"),
    variable("w_tc", "w_tc", ENERGY_DENSITY, "energy of compaction"),
    variable("w_td", "w_td", ENERGY_DENSITY, "energy of distortion"),
    variable("i_el", "I_el", NUMBER, "logarithmic strain of the fibre"),
    FAILED,
    ALIVE,
];

impl UserMaterial for FormulaYarn {
    const DESCRIPTION: Description = Description {
        title: "yarn by its formula",
        properties: &PROPERTIES,
        state: &STATE,
        directions: &[Direction::fibre(3)],
        energies: 0..3,
        failed: 4,
        alive: 5,
        reads: Reads::NOTHING,
        lost: None,
        refusal: None,
    };
    type Properties<R: Real> = [R; 6];
    type State<R: Real> = [R; 4];
    type Constants<R: Real> = [R; 3];

    fn constants<R: Real>(&[k_el, k_tc, k_td, ..]: &[R; 6]) -> [R; 3] {
        [k_el, k_tc, k_td]
    }

    /// As `thesis.rs` and `hyperelastic.rs` of the library have it; the fibre is the first axis.
    fn respond<R: Real>(&[k_el, k_tc, k_td]: &[R; 3], step: &Step<R, [R; 4]>) -> Response<R, [R; 4]> {
        let (zero, one, half) = (R::splat(0.0), R::splat(1.0), R::splat(0.5));
        let fibre = image(&step.f, step.fibre);
        let stretch = dot(fibre, fibre).sqrt();
        let e = scale(one / stretch, fibre);
        let [a, b] = [step.f[1], step.f[2]];
        let (a, b) = (along(a, -dot(a, e), e), along(b, -dot(b, e), e));
        let area = step.jacobian / stretch;
        let (i_el, i_tc) = (stretch.ln(), half * area.ln());
        let (elongation, compaction) = (i_el.max(zero), (-i_tc).max(zero));
        let per = half / area;
        let (mean, apart, slant) = (per * (dot(a, a) + dot(b, b)), per * (dot(a, a) - dot(b, b)), per * dot(a, b));
        let square = apart * apart + R::splat(4.0) * slant * slant;
        let s = square.sqrt();
        let series =
            one - square * (R::splat(1.0 / 6.0) - square * (R::splat(0.075) - square * R::splat(15.0 / 336.0)));
        let small = s.lt(R::splat(0.02));
        let quotient = R::select(small, series, (s + mean).ln() / s); // 2 I_td over s
        let i_td = half * quotient * s;
        let distortion = R::splat(0.25) * k_td * quotient;
        let tension = k_el * elongation;
        let pressure = k_tc * compaction + distortion * mean;
        let inverse = one / step.jacobian;
        let twice = one / area;
        let entry = |i: usize, j: usize| {
            let unit = if i == j { one } else { zero };
            let section = twice * (a[i] * a[j] + b[i] * b[j]);
            inverse * (tension * e[i] * e[j] + distortion * section - pressure * (unit - e[i] * e[j]))
        };
        let stress = [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)];
        let w_el = half * k_el * elongation * elongation;
        Response::new(stress, [w_el, k_tc * compaction * compaction, half * k_td * i_td * i_td, i_el])
    }

    fn wave_modulus<R: Real>(&[k_el, ..]: &[R; 3], _: &Step<R, [R; 4]>, _: &Response<R, [R; 4]>) -> Option<R> {
        Some(k_el + k_el)
    }

    fn resistance(&[k_el, k_tc, k_td, ..]: &[f64; 6]) -> Option<Resistance> {
        Some(Resistance { along: k_el, across: (2.0 * k_tc + k_td) / 4.0, shape: k_td / 4.0, hourglass: k_td })
    }
}

/// Where the nodes are after so many steps of this length, the striker's speed, the internal energy, and by which part
/// the whole energy has moved.
fn motion(laws: Laws, text: &str, steps: usize, longest: f64) -> (Vec<[f64; 3]>, f64, f64, f64) {
    let scene = Scene::parse_with(laws, "yarn.toml", text).unwrap_or_else(|error| panic!("{error}"));
    let yarn = StruckYarn::new(&scene.cases[0]).expect("it can be run");
    let mut solver = yarn.solver::<f64>().expect("a solver");
    solver.longest = longest;
    let mut balance = Balance::default();
    for _ in 0..steps {
        solver.accelerate(true, longest).expect("a step");
        balance.add(&solver.state.energies);
        solver.displace();
    }
    assert!((solver.state.time / (steps as f64 * longest) - 1.0).abs() < 1e-9, "every step has this length");
    let nodes = (0..solver.bodies[0].mesh.nodes.len()).map(|node| solver.bodies[0].position(node)).collect();
    let speed = solver.striker.as_ref().expect("it strikes").velocity;
    (nodes, speed, solver.state.energies.internal, balance.imbalance())
}

/// Four hundred steps: the formula in one's own words moves every node as the library's law does, but for roundings.
#[test]
fn the_same_formula_moves_the_same() {
    let keys = "speed = 100.0\nend = 1.0\n";
    let of_yarn = "density = 1.3514e-3\n";
    let values = "k_el = 82341.0\nk_tc = 1055.0\nk_td = 649.74\n";
    let own = format!("[scene.material]\n{of_yarn}[scene.material.properties]\n{values}");
    let library = format!(
        "[scene.hyperelastic]\nlaw = \"hyperelastic\"\n{of_yarn}[scene.hyperelastic.properties]\n{values}p = 2.0\n"
    );
    let of = |laws: Laws, material: &str| motion(laws, &scene_text(keys, material), 400, 4e-6);
    let (own, speed, energy, imbalance) = of(laws::<FormulaYarn>("FORMULA"), &own);
    let (library, library_speed, library_energy, _) = of(Laws::Toron, &library);
    let rest = motion(Laws::Toron, &scene_text(keys, ""), 1, 1e-9).0;
    let (mut farthest, mut apart) = (0.0_f64, 0.0_f64);
    for ((own, library), rest) in own.iter().flatten().zip(library.iter().flatten()).zip(rest.iter().flatten()) {
        farthest = farthest.max((library - rest).abs());
        apart = apart.max((own - library).abs());
    }
    assert!(farthest > 0.1, "the yarn has moved by {farthest} mm");
    assert!(apart < 1e-12 * farthest, "{apart} of {farthest}");
    assert!(library_energy > 0.1 && (energy / library_energy - 1.0).abs() < 1e-12, "{energy} {library_energy}");
    assert!((speed / library_speed - 1.0).abs() < 1e-12, "{speed} {library_speed}");
    assert!(imbalance < 1e-3, "{imbalance}");
}

const REINFORCED: &str =
    "[scene.material]\ndensity = 1.3514e-3\n[scene.material.properties]\nmu = 300.0\nlambda = 500.0\nk = 20000.0\n";

/// The energy that the law reports is what its stress has taken, up to the break and behind it.
#[test]
fn a_solid_with_fibres_breaks_and_keeps_its_energy() {
    let laws = laws::<ReinforcedSolid>("REINFORCED");
    let whole = strike(laws, &scene_text("speed = 60.0\nend = 0.02\n", REINFORCED));
    assert_eq!((whole.failed, whole.last().deleted), (None, 0));
    assert!(whole.balance.imbalance() < 5e-3 && whole.last().energies.internal > 1.0, "{:?}", whole.balance);
    let broken = strike(laws, &scene_text("speed = 160.0\nend = 0.03\n", &format!("{REINFORCED}stretch_lim = 1.03\n")));
    assert!(broken.failed.is_some() && broken.last().deleted > 0 && broken.failure.is_none());
    assert!(broken.balance.imbalance() < 5e-3, "{:?}", broken.balance);
    assert!(broken.course.broken.is_some());
}

/// A law that counts no energies has the work counted that is done on it; the time of a step reaches it.
#[test]
fn what_relaxes_has_its_work_counted() {
    let laws = laws::<ViscoelasticSolid>("VISCOELASTIC");
    let of = |tau: f64| {
        let material = format!(
            "[scene.material]\ndensity = 1.3514e-3\n[scene.material.properties]\nmu = 500.0\nlambda = 900.0\nmu_1 = 9000.0\n\
             tau = {tau:?}\n"
        );
        strike(laws, &scene_text("speed = 60.0\nend = 0.03\n", &material))
    };
    let runs = [1e3, 0.005].map(of);
    for run in &runs {
        assert!(run.balance.imbalance() < 5e-3 && run.last().energies.internal > 0.1, "{:?}", run.balance);
    }
    // What relaxes brakes the projectile less.
    let [held, relaxed] = runs.each_ref().map(|run| run.last().speed);
    assert!(relaxed > held + 1.0, "{relaxed} {held}");
}

/// A panel, too.
#[test]
fn a_panel_is_woven_of_it() {
    let text = format!(
        "units = \"mm-g-ms\"\n[weave]\npreset = \"kevlar-s706\"\nalong = 8\ncolumns = 4\n\
         [weave.panel]\nshape = \"rectangle\"\nhalf = [1.5, 1.5]\n\
         [scene]\nspeed = 50.0\nmass = 0.03\nradius = 1.0\ncontact-stiffness = 1e5\nend = 1e-3\n{REINFORCED}"
    );
    let laws = laws::<ReinforcedSolid>("REINFORCED");
    let scene = fabric::scene::Scene::parse_with(laws, "panel.toml", &text).unwrap_or_else(|error| panic!("{error}"));
    let panel = fabric::run::StruckPanel::new(&scene.cases[0]).expect("it can be run");
    let result = struck::run::run(&panel, None, &mut ()).unwrap_or_else(|error| panic!("{error}"));
    let last = result.last();
    assert!(last.speed < 50.0 && last.energies.internal > 1e-3 && result.balance.imbalance() < 5e-3, "{last:?}");
}

#[test]
fn what_the_host_cannot_give_is_refused_by_name() {
    let keys = "speed = 60.0\nend = 0.02\n";
    let reinforced = laws::<ReinforcedSolid>("REINFORCED");
    for (laws, text, message) in [
        (
            laws::<Warm>("WARM"),
            scene_text(keys, "[scene.material]\ndensity = 1e-3\nproperties.e = 1e4\n"),
            "the law warm reads the temperature, which scenes do not have",
        ),
        (
            reinforced,
            scene_text(&format!("{keys}failure = \"uniaxial\"\n"), REINFORCED),
            "yarn.toml:15: failure is that of the library's laws; allowed: none",
        ),
        (
            reinforced,
            scene_text(keys, ""),
            "the material is missing; allowed: the table material, of the law reinforced",
        ),
        (Laws::Toron, scene_text(keys, REINFORCED), "material is of a law of one's own"),
        (reinforced, scene_text("speed = 60000.0\nend = 0.02\n", REINFORCED), "speed is 60000; allowed: up to"),
        (
            reinforced,
            scene_text(keys, "[scene.material]\nproperties.mu = 3.0\nproperties.lambda = 3.0\nproperties.k = 3.0\n"),
            "density is missing",
        ),
    ] {
        let error = refused(laws, &text);
        assert!(error.contains(message), "{error}\n{message}");
    }
}

/// A law that reads the temperature.
#[derive(Clone, Copy, Debug, Default)]
struct Warm;

static MODULUS: [Property; 1] = [positive("e", "E", STRESS, None, "Young's modulus")];
static NOTHING: [StateVariable; 2] = [FAILED, ALIVE];

impl UserMaterial for Warm {
    const DESCRIPTION: Description = Description {
        title: "warm solid",
        properties: &MODULUS,
        state: &NOTHING,
        directions: &[],
        energies: 0..0,
        failed: 0,
        alive: 1,
        reads: Reads { temperature: true, ..Reads::NOTHING },
        lost: None,
        refusal: None,
    };
    type Properties<R: Real> = [R; 1];
    type State<R: Real> = [R; 0];
    type Constants<R: Real> = R;

    fn constants<R: Real>(&[e]: &[R; 1]) -> R {
        e
    }

    fn respond<R: Real>(e: &R, step: &Step<R, [R; 0]>) -> Response<R, [R; 0]> {
        let pressure = *e * (step.jacobian.ln() - R::splat(1e-5) * step.temperature);
        let zero = R::splat(0.0);
        Response::new([pressure, pressure, pressure, zero, zero, zero], [])
    }
}
