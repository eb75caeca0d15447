//! The library without the driver: one point, one deformation gradient.
//!
//! `cargo run --example one_point`

use nalgebra::Matrix3;
use toron::host::units::UnitSystem;
use toron::law::parameters;
use toron::law::state::{ENERGIES, FAILURE_INDEX, HYPERELASTIC_STATE, INVARIANTS};
use toron::{Hyperelastic, Request};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let units = UnitSystem::parse("mm-tonne-s").ok_or("no such unit system")?;
    let preset = parameters::preset("kevlar-km2-600").ok_or("no such preset")?;
    let pairs = preset.table().iter().zip(preset.values);
    let properties: Vec<f64> = pairs.map(|(property, &value)| units.from_si(value, property.dimension)).collect();
    let law = Hyperelastic::<f64>::new(&properties)?;

    // Stretched by 2 % along the fibre, pressed to 80 % across it.
    let f = Matrix3::from_diagonal(&[1.02, 1.0, 0.8].into());
    let point = law.point(&f, &[0.0; HYPERELASTIC_STATE], Request::ALL);
    println!("Cauchy stress 11 22 33 12 23 31, MPa   {:9.3?}", point.stress);
    println!("W_el W_tc W_td W_ld, mJ/mm³            {:9.3?}", &point.state[ENERGIES..INVARIANTS]);
    println!("I_el I_tc I_td I_ld                    {:9.5?}", &point.state[INVARIANTS..FAILURE_INDEX]);
    println!("failure index                          {:9.5}", point.state[FAILURE_INDEX]);
    Ok(())
}
