//! The arguments of a UMAT exactly as Abaqus/Standard passes them.

use std::ffi::c_char;

use nalgebra::Matrix3;

use super::call::{Call, NO_WISH};
use super::kinematics::Components;
use super::material::{MOST_FIELDS, Material};

pub type Reals = *mut f64;
/// A law may write to what is its caller's own.
pub type Whole = *mut i32;

/// `SUBROUTINE UMAT(STRESS, STATEV, DDSDDE, SSE, ...)`, with the length of CMNAME behind the last argument.
pub type Umat = unsafe extern "C" fn(
    Reals,       // STRESS
    Reals,       // STATEV
    Reals,       // DDSDDE
    Reals,       // SSE
    Reals,       // SPD
    Reals,       // SCD
    Reals,       // RPL
    Reals,       // DDSDDT
    Reals,       // DRPLDE
    Reals,       // DRPLDT
    Reals,       // STRAN
    Reals,       // DSTRAN
    Reals,       // TIME
    Reals,       // DTIME
    Reals,       // TEMP
    Reals,       // DTEMP
    Reals,       // PREDEF
    Reals,       // DPRED
    *mut c_char, // CMNAME
    Whole,       // NDI
    Whole,       // NSHR
    Whole,       // NTENS
    Whole,       // NSTATV
    Reals,       // PROPS
    Whole,       // NPROPS
    Reals,       // COORDS
    Reals,       // DROT
    Reals,       // PNEWDT
    Reals,       // CELENT
    Reals,       // DFGRD0
    Reals,       // DFGRD1
    Whole,       // NOEL
    Whole,       // NPT
    Whole,       // LAYER
    Whole,       // KSPT
    Whole,       // JSTEP(4)
    Whole,       // KINC
    usize,
);
/// What a call passes beside the arrays, and finds there after it.
pub struct Arguments {
    /// SSE, SPD, SCD.
    pub energies: [f64; 3],
    /// RPL, DRPLDT.
    heat: [f64; 2],
    /// DDSDDT, DRPLDE.
    pub by_temperature: Components,
    heat_by_strain: Components,
    strain: Components,
    strain_increment: Components,
    time: [f64; 2],
    time_step: f64,
    /// TEMP, DTEMP.
    temperature: [f64; 2],
    /// PREDEF, DPRED.
    fields: [[f64; MOST_FIELDS]; 2],
    coordinates: [f64; 3],
    rotation: Matrix3<f64>,
    pub next_step: f64,
    length: f64,
    f0: Matrix3<f64>,
    f1: Matrix3<f64>,
    /// NDI, NSHR, NTENS, NSTATV, NPROPS, NOEL, NPT, LAYER, KSPT, KINC.
    counts: [i32; 10],
    step: [i32; 4],
}

impl Arguments {
    pub fn new(call: &Call, material: &Material, properties: usize, fields: [[f64; MOST_FIELDS]; 2]) -> Arguments {
        let (all, direct) = (material.components as i32, material.direct() as i32);
        let [element, point] = call.place;
        Arguments {
            energies: call.energies,
            heat: [0.0; 2],
            by_temperature: [0.0; 6],
            heat_by_strain: [0.0; 6],
            strain: call.strain,
            strain_increment: call.strain_increment,
            time: call.time,
            time_step: call.time_step,
            temperature: [call.temperature, call.temperature_step],
            fields,
            coordinates: [0.0; 3],
            rotation: call.rotation,
            next_step: NO_WISH,
            length: 1.0,
            f0: call.f0,
            f1: call.f1,
            counts: [
                direct,
                all - direct,
                all,
                call.state.len() as i32,
                properties as i32,
                element,
                point,
                1,
                1,
                call.increment,
            ],
            // JSTEP: the step, a static one, whether NLGEOM, no perturbation.
            step: [call.step, 1, i32::from(!material.small_strain), 0],
        }
    }

    /// Calls the subroutine; the arrays are STRESS, STATEV, DDSDDE, PROPS.
    pub fn pass(&mut self, umat: Umat, [stress, state, modulus, constants]: [Reals; 4], mut name: [c_char; 80]) {
        let [heat, heat_by_temperature] = &mut self.heat;
        let [temperature, temperature_step] = &mut self.temperature;
        let [fields, field_steps] = &mut self.fields;
        let [elastic, plastic, creep] = &mut self.energies;
        let [direct, shear, all, states, properties, element, point, layer, section, increment] = &mut self.counts;
        // SAFETY: the arguments of a UMAT, each as long as Abaqus declares it; matrices are in Fortran's order. What
        // the subroutine does beyond is its author's affair, and this process is there to bear it.
        unsafe {
            umat(
                stress,
                state,
                modulus,
                elastic,
                plastic,
                creep,
                heat,
                self.by_temperature.as_mut_ptr(),
                self.heat_by_strain.as_mut_ptr(),
                heat_by_temperature,
                self.strain.as_mut_ptr(),
                self.strain_increment.as_mut_ptr(),
                self.time.as_mut_ptr(),
                &mut self.time_step,
                temperature,
                temperature_step,
                fields.as_mut_ptr(),
                field_steps.as_mut_ptr(),
                name.as_mut_ptr(),
                direct,
                shear,
                all,
                states,
                constants,
                properties,
                self.coordinates.as_mut_ptr(),
                self.rotation.as_mut_slice().as_mut_ptr(),
                &mut self.next_step,
                &mut self.length,
                self.f0.as_mut_slice().as_mut_ptr(),
                self.f1.as_mut_slice().as_mut_ptr(),
                element,
                point,
                layer,
                section,
                self.step.as_mut_ptr(),
                increment,
                name.len(),
            );
        }
    }

    /// Adds the inputs that the call has written to.
    pub fn note_written(
        &self,
        call: &Call,
        fields: &[[f64; MOST_FIELDS]; 2],
        given: &[f64],
        constants: &[f64],
        written: &mut Vec<&'static str>,
    ) {
        let changed = |before: &[f64], after: &[f64]| {
            !before.iter().map(|value| value.to_bits()).eq(after.iter().map(|value| value.to_bits()))
        };
        let [.., states, properties, element, point, _, _, increment] = self.counts;
        let numbers = [states, properties, element, point, increment, self.step[0]];
        let [of_element, of_point] = call.place;
        let before = [call.state.len() as i32, given.len() as i32, of_element, of_point, call.increment, call.step];
        let inputs = [
            ("PROPS", changed(given, constants)),
            ("STRAN", changed(&call.strain, &self.strain)),
            ("DSTRAN", changed(&call.strain_increment, &self.strain_increment)),
            ("DFGRD0", changed(call.f0.as_slice(), self.f0.as_slice())),
            ("DFGRD1", changed(call.f1.as_slice(), self.f1.as_slice())),
            ("DROT", changed(call.rotation.as_slice(), self.rotation.as_slice())),
            ("TIME", changed(&call.time, &self.time)),
            ("DTIME", changed(&[call.time_step], &[self.time_step])),
            ("TEMP, DTEMP", changed(&[call.temperature, call.temperature_step], &self.temperature)),
            ("PREDEF, DPRED", changed(fields.as_flattened(), self.fields.as_flattened())),
            ("a count or number", numbers != before),
        ];
        for (name, changed) in inputs {
            if changed && !written.contains(&name) {
                written.push(name);
            }
        }
    }
}
