//! What is measured of the hosts: their C entries, called on arrays as they keep them, in loops that do nothing else.
//! What such a call takes in a C program is measured by `ffi-tests/speed`; `.ci/long bench` compares the two.

use super::scene::Scene;
use crate::entries::aligned::Aligned;
use crate::entries::blocks::{SolverBlock, prepared};
use crate::entries::hosts::{
    CalculixPoint, Given, LsdynaElement, LsdynaVector, MgisPoint, MgisTangent, OnePoint, OpenradiossGroup,
    PointOutputs, Umat, VumatArrays,
};
use crate::entries::precision::BlockPrecision;
use toron::law::block::Precision;
use toron::law::parameters::HYPERELASTIC_PROPERTIES;
use toron::law::state::HYPERELASTIC_STATE;
use toron_c::HyperelasticLaw;

/// A C entry as its host calls it. Those for one point are called for one point after the other; but for `Point` they
/// prepare the law at every call.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Host {
    /// `toron_hyperelastic_point`, with a law that has been prepared.
    Point(PointOutputs),
    /// `toron_hyperelastic_point_with_properties`.
    PointWithProperties,
    /// `toron_hyperelastic_block`.
    Block,
    Umat {
        tangent: bool,
    },
    Vumat,
    Lsdyna,
    LsdynaVector,
    /// `toron_hyperelastic_block` in parts of a group of OpenRadioss, asked for the wave speed too.
    BlockOfGroup,
    /// The same in OpenRadioss's arrays.
    OpenRadioss,
    /// With dS/dE, which it wants at every call.
    Calculix,
    /// With dσ/dF or none.
    Mgis {
        tangent: bool,
    },
}

impl Host {
    /// Those in either precision.
    pub const BOTH: [Host; 10] = [
        Host::Point(PointOutputs::State),
        Host::Point(PointOutputs::Stress),
        Host::Point(PointOutputs::Tangent),
        Host::PointWithProperties,
        Host::Block,
        Host::Vumat,
        Host::Lsdyna,
        Host::LsdynaVector,
        Host::BlockOfGroup,
        Host::OpenRadioss,
    ];
    /// Those in double precision alone.
    pub const DOUBLE: [Host; 5] = [
        Host::Umat { tangent: false },
        Host::Umat { tangent: true },
        Host::Calculix,
        Host::Mgis { tangent: false },
        Host::Mgis { tangent: true },
    ];

    pub fn name(self) -> &'static str {
        match self {
            Host::Point(PointOutputs::State) => "C point",
            Host::Point(PointOutputs::Stress) => "C point, stress only",
            Host::Point(PointOutputs::Tangent) => "C point with dS/dE",
            Host::PointWithProperties => "C point with properties",
            Host::Block => "C block",
            Host::Umat { tangent: false } => "UMAT",
            Host::Umat { tangent: true } => "UMAT with DDSDDE",
            Host::Vumat => "VUMAT",
            Host::Lsdyna => "LS-DYNA scalar",
            Host::LsdynaVector => "LS-DYNA vectorised",
            Host::BlockOfGroup => "C blocks of 128, wave speed",
            Host::OpenRadioss => "OpenRadioss, groups of 128",
            Host::Calculix => "CalculiX with dS/dE",
            Host::Mgis { tangent: false } => "MGIS",
            Host::Mgis { tangent: true } => "MGIS with dsig/dF",
        }
    }
}

/// The arrays of the hosts, each with the scene's deformations, as it keeps them.
pub struct HostArrays<T> {
    properties: [T; HYPERELASTIC_PROPERTIES],
    law: HyperelasticLaw<T>,
    tangent: [[T; 6]; 6],
    state: Aligned<T>,
    vumat: VumatArrays<T>,
    lsdyna: Vec<LsdynaElement<T>>,
    lsdyna_vector: LsdynaVector<T>,
    groups: Vec<OpenradiossGroup<T>>,
    wave_speed: Aligned<T>,
    double: DoubleArrays,
}

/// Those of the hosts in double precision alone.
struct DoubleArrays {
    properties: [f64; HYPERELASTIC_PROPERTIES],
    ddsdde: [[f64; 6]; 6],
    umat: Vec<([f64; 9], Umat)>,
    calculix: Vec<CalculixPoint>,
    mgis: Vec<MgisPoint>,
}

/// The elements of a full group of OpenRadioss.
const GROUP: usize = 128;

impl<T: Precision + BlockPrecision> HostArrays<T> {
    /// With the law of these properties and the scene's deformations, or their symmetric parts for a host that passes a
    /// stretch: for small shears that is one.
    ///
    /// # Errors
    /// The properties are wrong.
    pub fn new(properties: &[T; HYPERELASTIC_PROPERTIES], scene: &Scene<T>) -> Result<Self, String> {
        let law = prepared(properties)?;
        let (n, stride) = (scene.n, scene.leading_dimension);
        let (mut vumat, mut lsdyna_vector) = (VumatArrays::new(n), LsdynaVector::new(n));
        let half = T::splat(0.5);
        let mut groups = (0..n)
            .step_by(GROUP)
            .map(|first| OpenradiossGroup::new(GROUP.min(n - first), properties, false))
            .collect::<Result<Vec<_>, i32>>()
            .map_err(|status| format!("OpenRadioss: status {status}"))?;
        for (i, point) in scene.points.iter().enumerate() {
            let f = |row: usize, column: usize| point.deformation_gradient[3 * column + row];
            for (c, (row, column)) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)].into_iter().enumerate() {
                vumat.stretch[c * n + i] = half * (f(row, column) + f(column, row));
            }
            for (c, &value) in point.deformation_gradient.iter().enumerate() {
                lsdyna_vector.set_gradient(i, c, value);
                groups[i / GROUP].gradient[c * OpenradiossGroup::<T>::LENGTH + i % GROUP] = value;
            }
        }
        let zeros = |components: usize| Aligned::new(T::splat(0.0), components * stride);
        let doubles = || scene.points.iter().map(|point| point.deformation_gradient.map(Into::into));
        let mut double = DoubleArrays {
            properties: properties.map(Into::into),
            ddsdde: [[0.0; 6]; 6],
            umat: doubles().map(|f| (f, Umat::FRESH)).collect(),
            calculix: doubles().map(CalculixPoint::new).collect(),
            mgis: doubles().map(|f| MgisPoint::new(&f)).collect(),
        };
        double.step();
        Ok(HostArrays {
            properties: *properties,
            law,
            tangent: [[T::splat(0.0); 6]; 6],
            state: zeros(HYPERELASTIC_STATE),
            vumat,
            lsdyna: scene.points.iter().map(|point| LsdynaElement::new(point.deformation_gradient)).collect(),
            lsdyna_vector,
            groups,
            wave_speed: zeros(1),
            double,
        })
    }
}

/// Calls a host's entry for all points.
pub fn call<T: Precision + BlockPrecision>(host: Host, scene: &mut Scene<T>, arrays: &mut HostArrays<T>) {
    let (law, properties) = (Given::Prepared(&arrays.law), &arrays.properties);
    let tangent = &mut arrays.tangent;
    match host {
        Host::Point(outputs) => OnePoint::call_each(&mut scene.points, law, outputs, tangent),
        Host::PointWithProperties => {
            OnePoint::call_each(&mut scene.points, Given::Properties(properties), PointOutputs::State, tangent);
        }
        Host::Block => drop(whole(scene, &mut arrays.state).arrays().call(law)),
        Host::Vumat => {
            arrays.vumat.call(properties);
            let VumatArrays { state_old, state_new, .. } = &mut arrays.vumat;
            std::mem::swap(state_old, state_new); // as Abaqus does from step to step
        }
        Host::Lsdyna => {
            for (element, point) in arrays.lsdyna.iter_mut().zip(&mut scene.points) {
                point.status = element.call(properties);
            }
        }
        Host::LsdynaVector => drop(arrays.lsdyna_vector.call(properties)),
        Host::BlockOfGroup => blocks_of_groups(scene, arrays),
        Host::OpenRadioss => {
            for group in &mut arrays.groups {
                group.call();
            }
        }
        Host::Umat { tangent } => arrays.double.umat(tangent),
        Host::Calculix => arrays.double.calculix(),
        Host::Mgis { tangent } => arrays.double.mgis(tangent),
    }
}

/// The scene as a block with stress, state and status.
pub fn whole<'a, T: Precision>(scene: &'a mut Scene<T>, state: &'a mut [T]) -> SolverBlock<'a, T> {
    SolverBlock {
        n: scene.n,
        leading_dimension: scene.leading_dimension,
        deformation_gradient: &scene.deformation_gradient,
        state,
        state_old: None,
        energies: true,
        failure: true,
        limit: None,
        stress: &mut scene.stress,
        wave_speed: None,
        tangent: None,
        status: &mut scene.status,
    }
}

/// The C entry for parts of the scene that are as long as a group of OpenRadioss, with what that asks for.
fn blocks_of_groups<T: Precision + BlockPrecision>(scene: &mut Scene<T>, arrays: &mut HostArrays<T>) {
    for first in (0..scene.n).step_by(GROUP) {
        let block = SolverBlock {
            n: GROUP.min(scene.n - first),
            leading_dimension: scene.leading_dimension,
            deformation_gradient: &scene.deformation_gradient[first..],
            state: &mut arrays.state[first..],
            state_old: None,
            energies: true,
            failure: true,
            limit: None,
            stress: &mut scene.stress[first..],
            wave_speed: Some((T::splat(1.0), &mut arrays.wave_speed[first..])),
            tangent: None,
            status: &mut scene.status[first..],
        };
        block.arrays().call(Given::Prepared(&arrays.law));
    }
}

impl DoubleArrays {
    /// The state of later steps, where points have failed, for the hosts that keep the old one apart.
    fn step(&mut self) {
        self.calculix();
        self.mgis(false);
        self.calculix.iter_mut().for_each(|point| point.state_old = point.state);
        self.mgis.iter_mut().for_each(|point| point.state_old = point.state);
    }

    fn umat(&mut self, tangent: bool) {
        for (f, point) in &mut self.umat {
            point.call(&self.properties, f, tangent.then_some(&mut self.ddsdde));
        }
    }

    fn calculix(&mut self) {
        for point in &mut self.calculix {
            point.call(&self.properties);
        }
    }

    fn mgis(&mut self, tangent: bool) {
        for point in &mut self.mgis {
            point.call(&self.properties, if tangent { MgisTangent::CauchyByGradient } else { MgisTangent::None });
        }
    }
}
