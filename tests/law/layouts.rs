//! Blocks in other layouts than component-major arrays of one leading dimension: points in rows, as NumPy keeps them,
//! and a leading dimension for each group; and which points are active.

use nalgebra::Matrix3;
use toron::host::blocks::{self, Given};
use toron::host::point_and_block::Block;
use toron::law::block::{Points, Strides, components, components_mut};
use toron::law::interface::Law;
use toron::law::state::{FAILED, HYPERELASTIC_STATE};
use toron::law::status;
use toron::{Arrays, Hyperelastic, Level, Measure};
use toron_test_support::block::levels;
use toron_test_support::deformations::{Ranges, deformation, samples};

/// More than are copied at a time, with a few left over.
const POINTS: usize = 70;

fn law() -> Hyperelastic<f64> {
    Hyperelastic::new(&[82341.0, 1055.0, 2.2, 649.74, 100.0, 0.0458, 1.8, 0.1, 0.6, 0.0, 0.8])
        .expect("valid properties")
}

/// Deformations, some of which fail, one inverted and one that is no number; old states, some of which have failed.
fn points() -> (Vec<Matrix3<f64>>, Vec<[f64; HYPERELASTIC_STATE]>) {
    let spread = Ranges { i_el: -0.05..0.08, i_tc: -0.3..0.1, i_td: 0.0..0.3, i_ld: 0.0..0.2 };
    let mut f: Vec<_> = samples(deformation(spread), POINTS).map(|sample| sample.f).collect();
    f[5] = Matrix3::from_diagonal(&[-1.0, 1.0, 1.0].into());
    f[40][(1, 2)] = f64::NAN;
    let mut state = vec![[0.0; HYPERELASTIC_STATE]; POINTS];
    for failed in [3, 50] {
        state[failed][FAILED] = 1.0;
    }
    (f, state)
}

/// Results by points: stress, state, modes, dS/dE, wave speed, active; and status.
type Results = (Vec<Vec<u64>>, Vec<i32>);

/// With component-major arrays of one leading dimension.
fn by_components(level: Level) -> Results {
    let (f, old) = points();
    let stride = POINTS + 3;
    let array = |components: usize| vec![0.0; components * stride];
    let mut gradient = array(9);
    let mut state = array(HYPERELASTIC_STATE);
    for i in 0..POINTS {
        for c in 0..9 {
            gradient[c * stride + i] = f[i][c];
        }
        for c in 0..HYPERELASTIC_STATE {
            state[c * stride + i] = old[i][c];
        }
    }
    let (mut stress, mut modes, mut tangent) = (array(6), array(24), array(36));
    let (mut wave, mut active, mut status) = (array(1), array(1), vec![1; stride]);
    let (energies, rest) = state.split_at_mut(4 * stride);
    let (invariants, failure) = rest.split_at_mut(4 * stride);
    let arrays = Arrays {
        n: POINTS,
        leading_dimension: stride,
        deformation_gradient: &gradient,
        density: 1.35e-9,
        stress: Some(&mut stress),
        energies: Some(energies),
        invariants: Some(invariants),
        failure: Some(failure),
        modes: Some(&mut modes),
        wave_speed: Some(&mut wave),
        tangent: Some(&mut tangent),
        measure: Measure::Material,
        status: Some(&mut status),
        active: Some(&mut active),
        level: Some(level),
        ..Arrays::default()
    };
    law().block(arrays).expect("a good call");
    let results = [&stress, &state, &modes, &tangent, &wave, &active].map(|array| array.chunks(stride));
    let columns: Vec<&[f64]> = results.into_iter().flatten().collect();
    let point = |i: usize| columns.iter().map(|column| column[i].to_bits()).collect();
    ((0..POINTS).map(point).collect(), status[..POINTS].to_vec())
}

/// With a row for each point in every array, F as rows of its matrix as C and NumPy keep it. An old state elsewhere, or
/// in place.
fn by_points(level: Level, in_place: bool) -> Results {
    let (f, old) = points();
    let gradient: Vec<[[f64; 3]; 3]> = f.iter().map(|f| f.transpose().data.0).collect();
    let mut state = if in_place { old.clone() } else { vec![[f64::NAN; HYPERELASTIC_STATE]; POINTS] };
    let (mut stress, mut modes, mut tangent) =
        (vec![[0.0; 6]; POINTS], vec![[0.0; 24]; POINTS], vec![[0.0; 36]; POINTS]);
    let (mut wave, mut active, mut status) = (vec![0.0; POINTS], vec![7.0; POINTS], vec![1; POINTS]);
    let (matrix, to) = (gradient.as_ptr().cast::<f64>(), state.as_mut_ptr().cast::<f64>());
    let from = if in_place { to.cast_const() } else { old.as_ptr().cast() };
    let entry = |row: usize, column: usize| matrix.wrapping_add(3 * row + column);
    let block = Points {
        f_new: std::array::from_fn(|c| entry(c % 3, c / 3)),
        state_old: Hyperelastic::parts(from, 1),
        density: 1.35e-9,
        stress: components_mut(stress.as_mut_ptr().cast(), 1),
        state_new: Hyperelastic::parts_mut(to, 1),
        modes: modes.as_mut_ptr().cast(),
        wave_speed: wave.as_mut_ptr(),
        tangent: tangent.as_mut_ptr().cast(),
        measure: Measure::Material,
        status: status.as_mut_ptr(),
        active: active.as_mut_ptr(),
        level: Some(level),
        strides: Strides {
            deformation_gradient: 9,
            fibre: 3,
            limit: 1,
            axes: 9,
            state: 11,
            stress: 6,
            modes: 24,
            tangent: 36,
        },
        ..Points::without_arrays(POINTS, 1)
    };
    // SAFETY: every array has a row for each point.
    unsafe { law().step(&block) }.expect("a good call");
    let point = |i: usize| {
        let row = [&stress[i][..], &state[i], &modes[i], &tangent[i], &[wave[i]], &[active[i]]].concat();
        row.iter().map(|x| x.to_bits()).collect()
    };
    ((0..POINTS).map(point).collect(), status)
}

#[test]
fn points_in_rows_give_the_same_bits() {
    for level in levels() {
        let wanted = by_components(level);
        for in_place in [true, false] {
            assert_eq!(by_points(level, in_place), wanted, "{level:?}, in place: {in_place}");
        }
    }
}

#[test]
fn groups_may_have_leading_dimensions_of_their_own() {
    let (f, _) = points();
    for level in levels() {
        let columns: Vec<f64> = (0..9).flat_map(|c| f.iter().map(move |f| f[c]).chain([0.0; 11])).collect();
        let (mut stress, mut energies, mut tangent) = (vec![0.0; 6 * 100], vec![0.0; 4 * 80], vec![0.0; 36 * POINTS]);
        let block = Points {
            f_new: components(columns.as_ptr(), POINTS + 11),
            stress: components_mut(stress.as_mut_ptr(), 100),
            state_new: [energies.as_mut_ptr(), std::ptr::null_mut(), std::ptr::null_mut()],
            tangent: tangent.as_mut_ptr(),
            measure: Measure::Material,
            level: Some(level),
            tangent_leading_dimension: POINTS,
            ..Points::without_arrays(POINTS, 80)
        };
        // SAFETY: every array has its components at its own distance.
        unsafe { law().step(&block) }.expect("a good call");
        let wanted = by_components(level).0;
        for i in (0..POINTS).filter(|i| ![3, 50].contains(i)) {
            let found = (0..6).map(|c| stress[100 * c + i]).chain((0..4).map(|c| energies[80 * c + i]));
            let found: Vec<u64> = found.chain((0..36).map(|c| tangent[POINTS * c + i])).map(f64::to_bits).collect();
            let wanted = [&wanted[i][..10], &wanted[i][41..77]].concat();
            assert_eq!(found, wanted, "point {i}, {level:?}");
        }
    }
    // A leading dimension below n is refused for the group that has it.
    let (f, mut tangent) = ([1.0; 9 * 4], [0.0; 36 * 4]);
    let block = Points {
        f_new: components(f.as_ptr(), 4),
        tangent: tangent.as_mut_ptr(),
        tangent_leading_dimension: 3,
        ..Points::without_arrays(4, 4)
    };
    // SAFETY: as above.
    let error = unsafe { law().step(&block) }.expect_err("too small");
    assert_eq!(error.code(), status::BAD_LEADING_DIMENSION);
}

/// Active are the points that carry a stress in the next call: evaluated, and not failed before or in this one.
#[test]
fn active_points_have_not_failed_and_can_be_evaluated() {
    for level in levels() {
        let (results, status) = by_components(level);
        let (mut failing, mut active) = (0, 0);
        for (i, (row, status)) in results.iter().zip(&status).enumerate() {
            let number = |at: usize| f64::from_bits(row[at]);
            let failed = number(6 + FAILED) != 0.0;
            assert_eq!(number(78), f64::from(*status == status::OK && !failed), "point {i}, {level:?}");
            failing += usize::from(failed && ![3, 50].contains(&i));
            active += usize::from(number(78) == 1.0);
        }
        assert!(failing > 0 && active > POINTS / 2, "{failing} fail, {active} active");
        assert_eq!((status[5], status[40]), (status::INVERTED, status::NOT_FINITE));
    }
}

/// The few points that are evaluated one by one say so too.
#[test]
fn few_points_are_active_alike() {
    let properties = [82341.0, 1055.0, 2.2, 649.74, 0.0, 0.0458, 1.8, 0.1, 1.0, 0.0, 0.0];
    let f = [[1.01, -1.0, 1.1], [0.0; 3], [0.0; 3], [0.0; 3], [1.0; 3], [0.0; 3], [0.0; 3], [0.0; 3], [1.0; 3]];
    let (mut failure, mut active) = ([[0.0; 3]; 3], [7.0; 3]);
    let mut block = Block { n: 3, failure: failure.as_mut_ptr().cast(), active: active.as_mut_ptr(), ..Block::empty() };
    block.deformation_gradient[0] = f.as_ptr().cast();
    // SAFETY: arrays of three points.
    let error =
        unsafe { blocks::hyperelastic_block(Given::Properties(&properties), &block) }.expect_err("an inverted point");
    assert_eq!((error.code(), active), (status::INVERTED, [1.0, 0.0, 0.0]));
    assert_eq!(failure[1], [0.0, 0.0, 1.0], "the second point fails, the inverted one does not");
}
