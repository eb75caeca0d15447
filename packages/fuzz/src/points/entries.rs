//! The calls of a case's entries, with guarded arrays in and out.

use std::ffi::CStr;
use std::ptr::null_mut;

use toron_c::{Block, LinearBlock, LinearPoint, Point, TORON_MESSAGE_CAPACITY};

use super::arrays::Array;
use super::case::{Case, Form, Old, Placing, group, with};
use super::faults::Fault;
use super::functions::{Arguments, Functions, Message};
use super::hosts;

/// How the points of a case are evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entry {
    /// In the case's layouts.
    Block,
    /// In arrays of one leading dimension.
    BlockWithProperties,
    /// The only point of a case, as a block of one, or by the entries for points.
    BlockOfOne,
    Point,
    PointWithProperties,
    /// Through the case's host; of one that has an entry for one point for the only point.
    Host,
}

impl Entry {
    pub fn is_point(self) -> bool {
        matches!(self, Entry::Point | Entry::PointWithProperties)
    }
}

/// The arrays that a caller passes in.
pub struct Inputs<T> {
    pub properties: Vec<T>,
    pub f: Array<T>,
    pub f_old: Array<T>,
    pub fibre: Array<T>,
    pub second_axis: Array<T>,
    pub limit: Array<T>,
    pub state: Array<T>,
}

/// What a call leaves behind.
#[derive(Clone)]
pub struct Outcome<T> {
    pub entry: Entry,
    pub code: i32,
    pub message: String,
    pub stress: Array<T>,
    pub state: Array<T>,
    /// Before the call, which may have written it.
    pub state_before: Array<T>,
    pub modes: Array<T>,
    pub tangent: Array<T>,
    pub wave_speed: Array<T>,
    pub active: Array<T>,
    pub axes: Array<T>,
    pub axes_before: Array<T>,
    pub status: Vec<i32>,
    /// The code and the tangents of LS-DYNA, which are of a further step.
    pub further: Option<(i32, Array<T>)>,
    /// What a host has beside: SSE, PNEWDT, SPD; energies per mass; rdt; the code of a stopped run.
    pub beside: Vec<f64>,
    /// Whether an input has been written to.
    pub input_written: bool,
}

/// Stands where no status has been written.
pub const NO_STATUS: i32 = 0x5a5a;
/// The entries of `status` before the first point and behind the last one.
const AROUND: usize = 2;

impl<T: Functions> Inputs<T> {
    pub fn new(case: &Case, entry: Entry) -> Self {
        let n = case.points.len();
        let array = |components: usize, group: usize| {
            Array::new(components, n, placing(case, entry, group), leading(case, entry))
        };
        let points = &case.points;
        Inputs {
            properties: case.properties.iter().map(|&x| T::splat(x)).collect(),
            f: array(9, group::GRADIENT).filled(points.iter().map(|p| &p.f[..])),
            f_old: array(9, group::GRADIENT).filled(points.iter().map(|p| &p.f_old[..])),
            fibre: array(3, group::FIBRE).filled(points.iter().map(|p| &p.fibre[..])),
            second_axis: array(3, group::FIBRE).filled(points.iter().map(|p| &p.second_axis[..])),
            limit: limits(case, entry).filled(points.iter().map(|p| std::slice::from_ref(&p.limit))),
            state: array(case.law.state(), group::STATE).filled(points.iter().map(|p| &p.state[..])),
        }
    }
}

/// The limits have a stride and nothing else.
fn limits<T: Functions>(case: &Case, entry: Entry) -> Array<T> {
    let placed = placing(case, entry, group::LIMIT);
    Array::new(1, case.points.len(), placed, case.points.len())
}

/// Only the block is placed as the case says; not every array has a pointer for each component.
fn placing(case: &Case, entry: Entry, group: usize) -> Placing {
    let placing = case.placings[group];
    let has_pointers = [group::GRADIENT, group::FIBRE, group::STRESS].contains(&group);
    match placing.form {
        _ if entry != Entry::Block => Placing::default(),
        Form::Pointers if !has_pointers => Placing { form: Form::Plain, ..placing },
        _ => placing,
    }
}

fn leading(case: &Case, entry: Entry) -> usize {
    case.points.len() + if entry == Entry::Block { case.gap } else { 0 }
}

impl<T: Functions> Outcome<T> {
    pub fn new(case: &Case, entry: Entry, inputs: &Inputs<T>) -> Self {
        let n = case.points.len();
        let array = |components: usize, group: usize| {
            Array::new(components, n, placing(case, entry, group), leading(case, entry))
        };
        let numbers = |components: usize| Array::plain(components, n);
        let state = if case.old == Old::InPlace { inputs.state.clone() } else { array(case.law.state(), group::STATE) };
        let axes = array(9, group::MODES).filled(case.points.iter().map(|p| &p.axes[..]));
        Outcome {
            entry,
            code: 0,
            message: String::new(),
            stress: array(6, group::STRESS),
            state_before: state.clone(),
            state,
            modes: array(24, group::MODES),
            tangent: array(case.tangent_size().pow(2), group::TANGENT),
            wave_speed: numbers(1),
            active: numbers(1),
            axes_before: axes.clone(),
            axes,
            status: vec![NO_STATUS; n + 2 * AROUND],
            further: None,
            beside: Vec::new(),
            input_written: false,
        }
    }

    /// With the symmetric parts of the tangents, which are 6 × 6.
    pub fn symmetric(mut self) -> Self {
        let before = self.tangent.clone();
        for i in 0..before.points {
            for c in 0..36 {
                // Halved first, as the library does it: the sum might overflow.
                let [half, mirrored] = [c, 6 * (c % 6) + c / 6].map(|place| before.get(place, i) * T::splat(0.5));
                self.tangent.set(c, i, half + mirrored);
            }
        }
        self
    }

    /// The status of a point, by its array or, of one point, by the code that is returned.
    pub fn status(&self, case: &Case, point: usize) -> Option<i32> {
        let has_array = case.asks(with::STATUS) && !self.entry.is_point() && self.entry != Entry::Host;
        match (has_array, self.stress.points) {
            (true, _) => Some(self.status[AROUND + point]),
            (false, 1) => Some(self.code),
            (false, _) => (self.code == 0).then_some(0),
        }
    }

    pub fn status_mut(&mut self, point: usize) -> &mut i32 {
        &mut self.status[AROUND + point]
    }

    pub fn wrote_beside_status(&self) -> bool {
        let n = self.status.len() - AROUND;
        self.status[..AROUND].iter().chain(&self.status[n..]).any(|&code| code != NO_STATUS)
    }

    fn status_pointer(&mut self) -> *mut i32 {
        self.status.as_mut_ptr().wrapping_add(AROUND)
    }
}

/// Calls an entry; a fault, if there is one, falsifies what comes back.
pub fn call<T: Functions>(entry: Entry, case: &Case, fault: Option<Fault>) -> Outcome<T> {
    let faulty = fault.and_then(|fault| fault.of_inputs(entry, case));
    let called = faulty.as_ref().unwrap_or(case);
    let mut inputs = Inputs::<T>::new(called, entry);
    let mut outcome = Outcome::new(called, entry, &inputs);
    let before = Inputs::<T>::new(called, entry);
    let mut message: Message = [0; TORON_MESSAGE_CAPACITY];
    if entry == Entry::Host {
        outcome.code = hosts::call(called, &mut inputs, &mut outcome, &mut message);
    } else {
        outcome.code = call_c(entry, called, &mut inputs, &mut outcome, &mut message);
    }
    outcome.message = text(&message);
    let pairs = [
        (&inputs.f, &before.f),
        (&inputs.f_old, &before.f_old),
        (&inputs.fibre, &before.fibre),
        (&inputs.second_axis, &before.second_axis),
        (&inputs.limit, &before.limit),
        (&inputs.state, &before.state),
    ];
    outcome.input_written = pairs.iter().any(|(a, b)| !a.is_as(b));
    if let Some(fault) = fault {
        fault.of_outcome(case, &mut outcome);
    }
    outcome
}

/// A message, which a function ends with a null.
fn text(message: &Message) -> String {
    let bytes = message.map(|c| c as u8);
    CStr::from_bytes_until_nul(&bytes).map_or_else(|_| "no end".into(), |text| text.to_string_lossy().into_owned())
}

fn call_c<T: Functions>(
    entry: Entry,
    case: &Case,
    inputs: &mut Inputs<T>,
    outcome: &mut Outcome<T>,
    message: &mut Message,
) -> i32 {
    let arguments = match (entry.is_point(), case.law.is_linear()) {
        (true, false) => Arguments::Point(point(case, inputs, outcome)),
        (true, true) => Arguments::LinearPoint(linear_point(case, inputs, outcome)),
        (false, false) => Arguments::Block(block(case, entry, inputs, outcome)),
        (false, true) => Arguments::LinearBlock(linear_block(case, entry, inputs, outcome)),
    };
    if matches!(entry, Entry::BlockWithProperties | Entry::PointWithProperties) {
        // SAFETY: the arrays have the sizes and the places that the structures say.
        return unsafe { T::with_properties(case.law, &inputs.properties, &arguments, message) };
    }
    let mut prepared = [0; 64];
    match T::prepare(case.law, &mut prepared, &inputs.properties, message) {
        // SAFETY: as above.
        0 => unsafe { T::prepared(case.law, &prepared, &arguments, message) },
        code => code,
    }
}

/// The pointer to a part of the old state, from this component on.
fn old_state<T: Functions>(
    case: &Case,
    inputs: &mut Inputs<T>,
    outcome: &mut Outcome<T>,
    component: usize,
) -> *const T {
    match case.old {
        Old::Null => null_mut(),
        Old::Apart => inputs.state.pointer(component),
        Old::InPlace => outcome.state.pointer(component),
    }
}

/// A pointer to a whole array, if it is wanted.
fn whole<T: Functions>(array: &mut Array<T>, wanted: bool) -> *mut T {
    if wanted { array.pointer(0) } else { null_mut() }
}

fn point<T: Functions>(case: &Case, inputs: &mut Inputs<T>, outcome: &mut Outcome<T>) -> Point<T> {
    Point {
        measure: case.measure,
        level: case.level,
        density: case.density,
        deformation_gradient: whole(&mut inputs.f, true),
        fibre: whole(&mut inputs.fibre, case.asks(with::FIBRE)),
        state_old: old_state(case, inputs, outcome, 0),
        state_new: whole(&mut outcome.state, case.asks_state()),
        stress: whole(&mut outcome.stress, case.asks(with::STRESS)),
        modes: whole(&mut outcome.modes, case.asks(with::MODES)),
        wave_speed: whole(&mut outcome.wave_speed, case.asks(with::WAVE_SPEED)),
        tangent: whole(&mut outcome.tangent, case.asks(with::TANGENT)),
        limit: whole(&mut inputs.limit, case.asks(with::LIMIT)),
        ..Point::empty()
    }
}

fn linear_point<T: Functions>(case: &Case, inputs: &mut Inputs<T>, outcome: &mut Outcome<T>) -> LinearPoint<T> {
    LinearPoint {
        rotation: case.rotation,
        criterion: case.criterion,
        measure: case.measure,
        level: case.level,
        density: case.density,
        f_old: whole(&mut inputs.f_old, true),
        f_new: whole(&mut inputs.f, true),
        fibre: whole(&mut inputs.fibre, case.asks(with::FIBRE)),
        second_axis: whole(&mut inputs.second_axis, case.asks(with::SECOND_AXIS)),
        axes: whole(&mut outcome.axes, case.rotation == 2),
        state_old: old_state(case, inputs, outcome, 0),
        state_new: whole(&mut outcome.state, case.asks(with::FAILURE)),
        stress: whole(&mut outcome.stress, case.asks(with::STRESS)),
        wave_speed: whole(&mut outcome.wave_speed, case.asks(with::WAVE_SPEED)),
        tangent: whole(&mut outcome.tangent, case.asks(with::TANGENT)),
        limit: whole(&mut inputs.limit, case.asks(with::LIMIT)),
        ..LinearPoint::empty()
    }
}

/// The leading dimension as a caller says it: 0 where it is the number of points.
fn given_leading(case: &Case, entry: Entry) -> usize {
    if leading(case, entry) == case.points.len() { 0 } else { leading(case, entry) }
}

fn block<T: Functions>(case: &Case, entry: Entry, inputs: &mut Inputs<T>, outcome: &mut Outcome<T>) -> Block<T> {
    let mut part = |place: usize, wanted: bool| if wanted { outcome.state.pointer(place) } else { null_mut() };
    let energies = part(0, case.asks(with::ENERGIES));
    let (invariants, failure) = (part(4, case.asks(with::INVARIANTS)), part(8, case.asks(with::FAILURE)));
    // In place of parts that are left out there is no old one.
    let [energies_old, invariants_old, failure_old] = [(0, with::ENERGIES), (4, with::INVARIANTS), (8, with::FAILURE)]
        .map(|(place, part)| {
            let is_there = case.old != Old::InPlace || case.asks(part);
            if is_there { old_state(case, inputs, outcome, place) } else { null_mut() }
        });
    Block {
        n: case.points.len(),
        leading_dimension: given_leading(case, entry),
        measure: case.measure,
        level: case.level,
        density: case.density,
        deformation_gradient: inputs.f.pointers(true).map(<*mut T>::cast_const),
        fibre: inputs.fibre.pointers(case.asks(with::FIBRE)).map(<*mut T>::cast_const),
        energies_old,
        invariants_old,
        failure_old,
        stress: outcome.stress.pointers(case.asks(with::STRESS)),
        energies,
        invariants,
        failure,
        modes: whole(&mut outcome.modes, case.asks(with::MODES)),
        tangent: whole(&mut outcome.tangent, case.asks(with::TANGENT)),
        wave_speed: whole(&mut outcome.wave_speed, case.asks(with::WAVE_SPEED)),
        active: whole(&mut outcome.active, case.asks(with::ACTIVE)),
        status: if case.asks(with::STATUS) { outcome.status_pointer() } else { null_mut() },
        deformation_gradient_layout: inputs.f.layout(),
        fibre_layout: inputs.fibre.layout(),
        state_layout: outcome.state.layout(),
        stress_layout: outcome.stress.layout(),
        modes_layout: outcome.modes.layout(),
        tangent_layout: outcome.tangent.layout(),
        limit: whole(&mut inputs.limit, case.asks(with::LIMIT)),
        limit_layout: inputs.limit.layout(),
        ..Block::empty()
    }
}

fn linear_block<T: Functions>(
    case: &Case,
    entry: Entry,
    inputs: &mut Inputs<T>,
    outcome: &mut Outcome<T>,
) -> LinearBlock<T> {
    LinearBlock {
        n: case.points.len(),
        leading_dimension: given_leading(case, entry),
        rotation: case.rotation,
        criterion: case.criterion,
        measure: case.measure,
        level: case.level,
        density: case.density,
        f_old: inputs.f_old.pointers(true).map(<*mut T>::cast_const),
        f_new: inputs.f.pointers(true).map(<*mut T>::cast_const),
        fibre: inputs.fibre.pointers(case.asks(with::FIBRE)).map(<*mut T>::cast_const),
        second_axis: inputs.second_axis.pointers(case.asks(with::SECOND_AXIS)).map(<*mut T>::cast_const),
        axes: whole(&mut outcome.axes, case.rotation == 2),
        state_old: old_state(case, inputs, outcome, 0),
        state_new: whole(&mut outcome.state, case.asks(with::FAILURE)),
        stress: outcome.stress.pointers(case.asks(with::STRESS)),
        tangent: whole(&mut outcome.tangent, case.asks(with::TANGENT)),
        wave_speed: whole(&mut outcome.wave_speed, case.asks(with::WAVE_SPEED)),
        active: whole(&mut outcome.active, case.asks(with::ACTIVE)),
        status: if case.asks(with::STATUS) { outcome.status_pointer() } else { null_mut() },
        deformation_gradient_layout: inputs.f.layout(),
        fibre_layout: inputs.fibre.layout(),
        axes_layout: outcome.axes.layout(),
        state_layout: outcome.state.layout(),
        stress_layout: outcome.stress.layout(),
        tangent_layout: outcome.tangent.layout(),
        limit: whole(&mut inputs.limit, case.asks(with::LIMIT)),
        limit_layout: inputs.limit.layout(),
        ..LinearBlock::empty()
    }
}
