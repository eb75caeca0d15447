//! What is measured of the hosts: their C entries, called on arrays as they keep them.

use std::hint::black_box;

use nalgebra::{Matrix3, Scalar};

use super::entries::each_point;
use super::scene::Scene;
use crate::entries::blocks::{SolverBlock, hyperelastic_block, prepared};
use crate::entries::hosts::{
    CalculixPoint, Given, LsdynaElement, LsdynaVector, MgisPoint, MgisTangent, OnePoint, OpenradiossGroup, Umat,
    VumatArrays,
};
use crate::entries::precision::BlockPrecision;
use toron::host::c::HyperelasticLaw;
use toron::host::mgis::INTEGRATED;
use toron::law::block::Precision;
use toron::law::parameters::HYPERELASTIC_PROPERTIES;
use toron::law::state::HYPERELASTIC_STATE;
use toron::law::status;

/// A C entry as its host calls it. Those for one point are called point by point on the scene's arrays; but for `Point` they
/// prepare the law at every call. The others have arrays of their own, laid out as the host keeps them, with the scene's
/// deformations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Host {
    /// `toron_hyperelastic_point`, with a law that has been prepared, with dS/dE or with none.
    Point {
        tangent: bool,
    },
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
    pub const BOTH: [Host; 9] = [
        Host::Point { tangent: false },
        Host::Point { tangent: true },
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
            Host::Point { tangent: false } => "C point",
            Host::Point { tangent: true } => "C point with dS/dE",
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

/// The arrays of the hosts that keep points in arrays.
pub struct HostArrays<T> {
    law: HyperelasticLaw<T>,
    state: Vec<T>,
    vumat: VumatArrays<T>,
    lsdyna: LsdynaVector<T>,
    groups: Vec<OpenradiossGroup<T>>,
    wave_speed: Vec<T>,
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
        let (mut vumat, mut lsdyna) = (VumatArrays::new(n), LsdynaVector::new(n));
        let half = T::splat(0.5);
        let mut groups = (0..n)
            .step_by(GROUP)
            .map(|first| OpenradiossGroup::new(GROUP.min(n - first), properties, false))
            .collect::<Result<Vec<_>, i32>>()
            .map_err(|status| format!("OpenRadioss: status {status}"))?;
        for i in 0..n {
            let f = |row: usize, column: usize| scene.deformation_gradient[(3 * column + row) * stride + i];
            for (c, (row, column)) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)].into_iter().enumerate() {
                vumat.stretch[c * n + i] = half * (f(row, column) + f(column, row));
            }
            for c in 0..9 {
                lsdyna.history[(HYPERELASTIC_STATE + c) * n + i] = f(c % 3, c / 3);
                groups[i / GROUP].gradient[c * OpenradiossGroup::<T>::LENGTH + i % GROUP] = f(c % 3, c / 3);
            }
        }
        let zeros = |components: usize| vec![T::splat(0.0); components * stride];
        let (state, wave_speed) = (zeros(HYPERELASTIC_STATE), zeros(1));
        Ok(HostArrays { law, state, vumat, lsdyna, groups, wave_speed })
    }
}

/// Calls a host's entry for all points.
pub fn call<T: Precision + BlockPrecision + Scalar>(
    host: Host,
    properties: &[T; HYPERELASTIC_PROPERTIES],
    scene: &mut Scene<T>,
    arrays: &mut HostArrays<T>,
) {
    let columns = |f: &Matrix3<T>| -> [T; 9] { std::array::from_fn(|c| f[c]) };
    let law = &arrays.law;
    match host {
        Host::Point { .. } | Host::PointWithProperties => {
            let tangent = host == Host::Point { tangent: true };
            let prepared = host != Host::PointWithProperties;
            let law = if prepared { Given::Prepared(law) } else { Given::Properties(properties) };
            let mut point = OnePoint::default();
            each_point(scene, |f, state| {
                point.state = *state;
                let status = point.call(law, &columns(f), tangent);
                black_box(&point.tangent);
                (point.stress, point.state, status)
            });
        }
        Host::Block => {
            let block = SolverBlock {
                n: scene.n,
                leading_dimension: scene.leading_dimension,
                deformation_gradient: &scene.deformation_gradient,
                state: &mut arrays.state,
                energies: true,
                failure: true,
                stress: &mut scene.stress,
                wave_speed: None,
                status: &mut scene.status,
            };
            hyperelastic_block(law, block);
        }
        Host::Vumat => {
            arrays.vumat.call(properties);
            let VumatArrays { state_old, state_new, .. } = &mut arrays.vumat;
            std::mem::swap(state_old, state_new); // as Abaqus does from step to step
        }
        Host::Lsdyna => {
            let zero = T::splat(0.0);
            let mut element = LsdynaElement { stress: [zero; 6], history: [zero; HYPERELASTIC_STATE + 9] };
            each_point(scene, |f, state| {
                let (old, gradient) = element.history.split_at_mut(HYPERELASTIC_STATE);
                old.copy_from_slice(state);
                gradient.copy_from_slice(&columns(f));
                let status = element.call(properties);
                (element.stress, std::array::from_fn(|c| element.history[c]), status)
            });
        }
        Host::LsdynaVector => drop(arrays.lsdyna.call(properties)),
        Host::BlockOfGroup => blocks_of_groups(scene, arrays),
        Host::OpenRadioss => {
            for group in &mut arrays.groups {
                group.call();
            }
        }
        Host::Umat { .. } | Host::Calculix | Host::Mgis { .. } => double(host, &properties.map(Into::into), scene),
    }
}

/// The C entry for parts of the scene that are as long as a group of OpenRadioss, with what that asks for.
fn blocks_of_groups<T: Precision + BlockPrecision + Scalar>(scene: &mut Scene<T>, arrays: &mut HostArrays<T>) {
    for first in (0..scene.n).step_by(GROUP) {
        let block = SolverBlock {
            n: GROUP.min(scene.n - first),
            leading_dimension: scene.leading_dimension,
            deformation_gradient: &scene.deformation_gradient[first..],
            state: &mut arrays.state[first..],
            energies: true,
            failure: true,
            stress: &mut scene.stress[first..],
            wave_speed: Some((T::splat(1.0), &mut arrays.wave_speed[first..])),
            status: &mut scene.status[first..],
        };
        hyperelastic_block(&arrays.law, block);
    }
}

/// The hosts in double precision alone.
fn double<T: Precision + Scalar>(host: Host, properties: &[f64; HYPERELASTIC_PROPERTIES], scene: &mut Scene<T>) {
    let (mut umat, mut calculix, mut mgis) = (Umat::FRESH, CalculixPoint::default(), MgisPoint::FRESH);
    each_point(scene, |f, state| {
        let (columns, state): ([f64; 9], _) = (std::array::from_fn(|c| f[c].into()), state.map(Into::into));
        let (stress, state, status) = match host {
            Host::Umat { tangent } => {
                umat.statev = state;
                let status = umat.call(properties, &columns, tangent);
                black_box(&umat.ddsdde);
                (umat.stress, umat.statev, status)
            }
            Host::Mgis { tangent } => {
                let [f11, f21, f31, f12, f22, f32, f13, f23, f33] = columns;
                mgis.gradients = [f11, f22, f33, f12, f21, f13, f31, f23, f32];
                mgis.state_old = state;
                let result =
                    mgis.call(properties, if tangent { MgisTangent::CauchyByGradient } else { MgisTangent::None });
                black_box(&mgis.k);
                (mgis.stress, mgis.state, result - INTEGRATED)
            }
            _ => {
                calculix.state_old = state;
                calculix.call(properties, &columns);
                black_box(&calculix.stiffness);
                (calculix.stress, calculix.state, status::OK)
            }
        };
        (stress.map(T::splat), state.map(T::splat), status)
    });
}
