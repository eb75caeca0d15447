//! A law of one's own, as a program of its own has it: its names in files and solvers, and its evaluation behind one
//! interface.

use std::fmt;
use std::ptr::{null, null_mut};
use std::sync::Arc;

use crate::entries::own_block::{BlockLaw, PrepareBlock};
use crate::entries::precision::BlockPrecision;
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use toron::Level;
use toron::host::laws::{LAWS, LibraryLaw};
use toron::host::prepared::AsNumbers;
use toron::host::{Material, is_name, is_number};
use toron::law::block::Circumstances;
use toron::law::description::Description;
use toron::law::interface::{Law, Points};
use toron::law::resistance::{Resistance, ShearLimit};
use toron::law::status;
use toron::{Error, Measure};
use toron_c::TORON_FRICTIONAL;
use toron_solvers::c_header;

/// A law that a program knows by its description alone: one of somebody's own, or a further one of the library's.
pub struct OwnLaw {
    /// What its symbols in the solvers' libraries begin with, in capitals.
    pub symbol: &'static str,
    /// As files have it: the symbol in small letters.
    pub name: String,
    /// OpenRadioss's nn of `/MAT/USERnn`.
    pub number: i32,
    pub description: Description,
    /// Its names where it is one of the library's, which the program knows by its description alone.
    pub library: Option<&'static LibraryLaw>,
    /// What its C header is made by.
    pub header: fn(&str) -> String,
    prepare: Prepare,
    /// For blocks of points, in both precisions.
    pub(crate) blocks: (PrepareBlock<f64>, PrepareBlock<f32>),
}

/// From properties to the law.
type Prepare = fn(&[f64]) -> Result<Arc<dyn Prepared>, Error>;

impl OwnLaw {
    /// # Errors
    /// The name is not made of capitals, digits and underscores with a capital first, or the number is not from 1 to
    /// 99.
    pub fn new<M>(symbol: &'static str, number: i32) -> Result<OwnLaw, String>
    where
        M: Material<f64> + Material<f32>,
        <M as Material<f64>>::Law: AsNumbers<f64> + Send + Sync + 'static,
        <M as Material<f32>>::Law: AsNumbers<f32> + Send + Sync + 'static,
    {
        if !is_name(symbol) {
            let allowed = "capitals, digits and underscores, a capital first";
            return Err(format!("the law's name is \"{symbol}\"; allowed: {allowed}"));
        }
        if !is_number(number) {
            return Err(format!("the law's number in OpenRadioss is {number}; allowed: 1 to 99"));
        }
        Ok(OwnLaw {
            symbol,
            name: symbol.to_ascii_lowercase(),
            number,
            description: <<M as Material<f64>>::Law as Law<f64>>::DESCRIPTION,
            library: None,
            header: c_header::<M>,
            prepare: |values| Ok(Arc::new(<M as Material<f64>>::Law::new(values)?)),
            blocks: (
                |values| Ok(Arc::new(<M as Material<f64>>::Law::new(values)?)),
                |values| Ok(Arc::new(<M as Material<f32>>::Law::new(values)?)),
            ),
        })
    }

    /// A law of the library.
    pub fn of_library<M>(law: &'static LibraryLaw) -> OwnLaw
    where
        M: Material<f64> + Material<f32>,
        <M as Material<f64>>::Law: AsNumbers<f64> + Send + Sync + 'static,
        <M as Material<f32>>::Law: AsNumbers<f32> + Send + Sync + 'static,
    {
        OwnLaw {
            symbol: law.symbol,
            name: law.name.to_string(),
            number: law.user,
            description: <<M as Material<f64>>::Law as Law<f64>>::DESCRIPTION,
            library: Some(law),
            header: c_header::<M>,
            prepare: |values| Ok(Arc::new(<M as Material<f64>>::Law::new(values)?)),
            blocks: (
                |values| Ok(Arc::new(<M as Material<f64>>::Law::new(values)?)),
                |values| Ok(Arc::new(<M as Material<f32>>::Law::new(values)?)),
            ),
        }
    }

    /// # Errors
    /// The first property that is wrong.
    pub fn prepared(&'static self, values: &[f64]) -> Result<Own, Error> {
        Ok(Own { law: self, values: values.to_vec(), prepared: (self.prepare)(values)? })
    }
}

/// Laws are told apart by their names.
impl PartialEq for OwnLaw {
    fn eq(&self, other: &OwnLaw) -> bool {
        self.symbol == other.symbol
    }
}

impl Eq for OwnLaw {}

impl fmt::Debug for OwnLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol)
    }
}

/// A law of one's own, prepared, and the properties that it was prepared from.
#[derive(Clone)]
pub struct Own {
    pub law: &'static OwnLaw,
    pub values: Vec<f64>,
    prepared: Arc<dyn Prepared>,
}

impl fmt::Debug for Own {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {:?}", self.law.symbol, self.values)
    }
}

/// The stretch at which a bar's stiffness is taken.
const HARDLY: f64 = 1e-6;

/// Points of a call: component `c` of point `i` is number `c · stride + i` of an array.
pub struct PointArrays {
    pub n: usize,
    pub stride: usize,
    /// F at the start and at the end of the step, by columns.
    pub f_old: Vec<f64>,
    pub f: Vec<f64>,
    /// The length of the step, and the time at its end.
    pub time_increment: f64,
    pub time: f64,
    /// The temperature of each point; empty where it is not known.
    pub temperature: Vec<f64>,
    /// The fibre direction of each point; empty for that of the properties.
    pub fibre: Vec<f64>,
    /// The state before the call, and after it.
    pub state: Vec<f64>,
    /// Cauchy stress 11 22 33 12 23 31.
    pub stress: Vec<f64>,
    /// ρ0 c² for a bound c of the wave speed; empty where none is wanted.
    pub wave_modulus: Vec<f64>,
    /// The tangent of this measure by rows, where one is wanted.
    pub measure: Option<Measure>,
    pub tangent: Vec<f64>,
    pub status: Vec<i32>,
    /// The instructions to use; none for the best.
    pub level: Option<Level>,
}

impl Own {
    /// Whether it is the library's yarn law with friction.
    pub fn is_frictional(&self) -> bool {
        self.law.library.is_some_and(|law| std::ptr::eq(law, &LAWS[TORON_FRICTIONAL as usize]))
    }

    /// Material axes in the reference placement, the fibre first.
    pub fn axes(&self) -> [[f64; 3]; 3] {
        self.prepared.axes()
    }

    pub fn bulk_and_shear(&self) -> [f64; 2] {
        self.prepared.bulk_and_shear()
    }

    /// What resists the motions of an element of it.
    pub fn resistance(&self) -> Resistance {
        self.prepared.resistance()
    }

    /// The most shear that viscosity and hourglass control may add to that of its section.
    pub fn shear_limit(&self) -> Option<ShearLimit> {
        self.prepared.shear_limit()
    }

    /// The stiffness of a bar along the fibre, or the first axis, that is hardly stretched: that of the tangent where
    /// no stress changes across. None where it is not positive.
    pub fn youngs_modulus(&self) -> Option<f64> {
        let mut point = self.at_rest(1, 1, Some(Measure::Jaumann));
        // At rest itself a fibre that bears tension alone has no stiffness yet.
        let fibre = Vector3::from(self.axes()[0]);
        let stretched = Matrix3::identity() + HARDLY * fibre * fibre.transpose();
        point.f.copy_from_slice(stretched.as_slice());
        self.try_step(&mut point).ok()?;
        // The least energy of the strains of which the one along the fibre is 1: m·εm = n·ε, ε with shears twice.
        let [x, y, z] = self.axes()[0];
        let n = SVector::<f64, 6>::from([x * x, y * y, z * z, x * y, y * z, z * x]);
        let stiffness = SMatrix::<f64, 6, 6>::from_fn(|i, j| point.tangent[6 * i + j]);
        let unit = n.normalize();
        let across = SMatrix::<f64, 6, 6>::identity() - unit * unit.transpose();
        let free = (across * stiffness * across).pseudo_inverse(1e-12 * stiffness.norm()).ok()?;
        let coupling = across * stiffness * unit;
        let modulus = (unit.dot(&(stiffness * unit)) - coupling.dot(&(free * coupling))) / n.norm_squared();
        Some(modulus).filter(|modulus| *modulus > 0.0 && modulus.is_finite())
    }

    /// The law in a precision, for blocks of points.
    ///
    /// # Errors
    /// A property does not fit the precision.
    pub fn block_law<T: BlockPrecision>(&self) -> Result<Arc<dyn BlockLaw<T>>, Error> {
        let values: Vec<T> = self.values.iter().map(|&value| T::from_f64(value)).collect();
        T::own(self.law)(&values)
    }

    /// That the law gives numbers at rest.
    ///
    /// # Errors
    /// It does not: why, as far as it is known.
    pub fn check_at_rest(&self) -> Result<(), Error> {
        let code = self.prepared.step(&mut self.at_rest(1, 1, None))?;
        match self.prepared.told(code)? {
            status::OK => Ok(()),
            code => Err(Error::Plain(code)),
        }
    }

    /// The state of a point that nothing has happened to.
    pub fn fresh(&self) -> Vec<f64> {
        self.prepared.fresh()
    }

    /// `n` points at rest with fresh states.
    pub fn at_rest(&self, n: usize, stride: usize, measure: Option<Measure>) -> PointArrays {
        let filled = |values: &[f64]| values.iter().flat_map(|&value| vec![value; stride]).collect::<Vec<f64>>();
        let f = filled(Matrix3::<f64>::identity().as_slice());
        let size = measure.map_or(0, |measure| if measure == Measure::Nominal { 9 } else { 6 });
        PointArrays {
            n,
            stride,
            f_old: f.clone(),
            f,
            time_increment: 0.0,
            time: 0.0,
            temperature: Vec::new(),
            fibre: Vec::new(),
            state: filled(&self.fresh()),
            stress: vec![0.0; 6 * stride],
            wave_modulus: vec![0.0; stride],
            measure,
            tangent: vec![0.0; size * size * stride],
            status: vec![0; n],
            level: None,
        }
    }

    /// Evaluates the points. A call that is refused as a whole gives each its code.
    pub fn step(&self, points: &mut PointArrays) {
        if let Err(error) = self.try_step(points) {
            points.status.fill(error.code());
        }
    }

    /// Evaluates the points.
    ///
    /// # Errors
    /// The call is refused as a whole.
    pub fn try_step(&self, points: &mut PointArrays) -> Result<(), Error> {
        self.prepared.step(points).map(|_| ())
    }

    /// One point: a step from one deformation gradient and time to others.
    pub fn point(
        &self,
        [old, f]: [&Matrix3<f64>; 2],
        [start, time]: [f64; 2],
        temperature: Option<f64>,
        state: &[f64],
        measure: Option<Measure>,
    ) -> PointArrays {
        let temperature = temperature.into_iter().collect();
        let mut point = PointArrays { time_increment: time - start, time, temperature, ..self.at_rest(1, 1, measure) };
        point.f_old.copy_from_slice(old.as_slice());
        point.f.copy_from_slice(f.as_slice());
        point.state.copy_from_slice(state);
        self.step(&mut point);
        point
    }
}

/// What a program asks of a law without knowing its type.
trait Prepared: Send + Sync {
    fn axes(&self) -> [[f64; 3]; 3];
    fn bulk_and_shear(&self) -> [f64; 2];
    fn resistance(&self) -> Resistance;
    fn shear_limit(&self) -> Option<ShearLimit>;
    fn told(&self, code: i32) -> Result<i32, Error>;
    fn fresh(&self) -> Vec<f64>;
    fn step(&self, points: &mut PointArrays) -> Result<i32, Error>;
}

impl<L: Law<f64> + Send + Sync> Prepared for L {
    fn axes(&self) -> [[f64; 3]; 3] {
        Law::axes(self)
    }

    fn bulk_and_shear(&self) -> [f64; 2] {
        Law::bulk_and_shear(self)
    }

    fn resistance(&self) -> Resistance {
        Law::resistance(self)
    }

    fn shear_limit(&self) -> Option<ShearLimit> {
        Law::shear_limit(self)
    }

    fn told(&self, code: i32) -> Result<i32, Error> {
        Law::told(self, code)
    }

    fn fresh(&self) -> Vec<f64> {
        L::fresh().as_ref().to_vec()
    }

    fn step(&self, points: &mut PointArrays) -> Result<i32, Error> {
        let PointArrays { n, stride, f_old, f, time_increment, time, temperature, .. } = points;
        let PointArrays { fibre, state, stress, wave_modulus, measure, tangent, status, level, .. } = points;
        let components = |array: &[f64]| std::array::from_fn(|c| array[c * *stride..].as_ptr());
        let own = Points {
            f_old: components(f_old),
            f_new: components(f),
            circumstances: Circumstances {
                time_increment: *time_increment,
                time: *time,
                temperature: if temperature.is_empty() { null() } else { temperature.as_ptr() },
            },
            state_old: L::parts(state.as_ptr(), *stride),
            state_new: L::parts_mut(state.as_mut_ptr(), *stride),
            // With the density 1 the square of the speed is the modulus.
            density: 1.0,
            stress: std::array::from_fn(|c| stress[c * *stride..].as_mut_ptr()),
            wave_speed: if wave_modulus.is_empty() { null_mut() } else { wave_modulus.as_mut_ptr() },
            status: status.as_mut_ptr(),
            level: *level,
            ..Points::without_arrays(*n, *stride)
        };
        let fibred = match fibre.is_empty() {
            true => own,
            false => Points { fibre: std::array::from_fn(|c| fibre[c * *stride..].as_ptr()), ..own },
        };
        let call = match measure {
            None => fibred,
            Some(measure) => Points { tangent: tangent.as_mut_ptr(), measure: *measure, ..fibred },
        };
        // SAFETY: `at_rest` has made the arrays with so many components of `stride` numbers each, and none overlaps
        // another one.
        let worst = unsafe { Law::step(self, &call) };
        wave_modulus.iter_mut().for_each(|speed| *speed *= *speed);
        worst
    }
}
