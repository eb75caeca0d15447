//! libtoron_mgis: both laws as MGIS, MTest and whatever else loads MFront's libraries find them. See `toron::host::mgis`.
//!
//! A library of its own, since the names of the symbols are MFront's choice: `BEHAVIOUR_HYPOTHESIS` is the function, and
//! `BEHAVIOUR_...` are the data that describe it, the same for all hypotheses.

use toron::host::mgis::BehaviourDataView;

/// A data symbol: the behaviour's name and the rest of the symbol's name, its type and its value.
macro_rules! symbol {
    ($behaviour:literal, $name:expr, $static:ident: $type:ty = $value:expr) => {
        #[unsafe(export_name = concat!($behaviour, "_", $name))]
        pub static $static: $type = $value;
    };
}

/// A bound of a property under both of MFront's names: outside its bounds the property is refused.
#[cfg(target_arch = "x86_64")]
macro_rules! bound {
    ($behaviour:literal, $property:literal, $side:literal, $value:expr) => {
        const _: () = {
    symbol!($behaviour, concat!($property, "_", $side, "Bound"), STANDARD: LongDouble = $value);
    symbol!($behaviour, concat!($property, "_", $side, "PhysicalBound"), PHYSICAL: LongDouble = $value);
        };
    };
}

/// The data symbols of a behaviour, from the tables of its law. The properties that have bounds are listed, since a name of a symbol
/// cannot be computed; the list is checked against the table.
macro_rules! behaviour {
    ($module:ident, $behaviour:literal, $law:path, bounds of $($property:literal),*) => {
        mod $module {
            use core::ffi::CStr;

            use toron::host::mgis::symbols::{NAME, Text, property_names, state_names, texts};
            #[cfg(target_arch = "x86_64")]
            use toron::host::mgis::symbols::{LongDouble, bounds, have_bounds};

            const fn text(text: &'static CStr) -> Text {
                Text::new(text)
            }

            const PROPERTIES: usize = $law.properties.len();
            const STATE: usize = $law.state.len();
            static PROPERTY_NAMES: [[u8; NAME]; PROPERTIES] = property_names($law.properties);
            static STATE_NAMES: [[u8; NAME]; STATE] = state_names($law.state);
            const NAME_OF_BEHAVIOUR: &CStr = match CStr::from_bytes_with_nul(concat!($behaviour, "\0").as_bytes()) {
                Ok(name) => name,
                Err(_) => c"",
            };

            // A behaviour of finite strain, from F to the Cauchy stress, isotropic to the host.
            symbol!($behaviour, "mfront_mkt", MATERIAL_KNOWLEDGE_TYPE: u16 = 1);
            symbol!($behaviour, "mfront_interface", INTERFACE: Text = text(c"Generic"));
            symbol!($behaviour, "mfront_ept", ENTRY_POINT: Text = text(NAME_OF_BEHAVIOUR));
            symbol!($behaviour, "api_version", API_VERSION: u16 = 1);
            symbol!($behaviour, "src", SOURCE: Text = text(c"toron"));
            symbol!($behaviour, "BehaviourType", BEHAVIOUR_TYPE: u16 = 2);
            symbol!($behaviour, "BehaviourKinematic", KINEMATIC: u16 = 3);
            symbol!($behaviour, "SymmetryType", SYMMETRY: u16 = 0);
            symbol!($behaviour, "ElasticSymmetryType", ELASTIC_SYMMETRY: u16 = 0);
            symbol!($behaviour, "requiresStiffnessTensor", NEEDS_STIFFNESS: u16 = 0);
            symbol!($behaviour, "requiresThermalExpansionCoefficientTensor", NEEDS_EXPANSION: u16 = 0);
            symbol!($behaviour, "nModellingHypotheses", HYPOTHESIS_COUNT: u16 = 3);
            symbol!(
                $behaviour,
                "ModellingHypotheses",
                HYPOTHESES: [Text; 3] = [text(c"Tridimensional"), text(c"PlaneStrain"), text(c"Axisymmetrical")]
            );

            symbol!($behaviour, "nGradients", GRADIENT_COUNT: u16 = 1);
            symbol!($behaviour, "Gradients", GRADIENTS: [Text; 1] = [text(c"DeformationGradient")]);
            symbol!($behaviour, "GradientsTypes", GRADIENT_TYPES: [i32; 1] = [3]);
            symbol!($behaviour, "nThermodynamicForces", FORCE_COUNT: u16 = 1);
            symbol!($behaviour, "ThermodynamicForces", FORCES: [Text; 1] = [text(c"Stress")]);
            symbol!($behaviour, "ThermodynamicForcesTypes", FORCE_TYPES: [i32; 1] = [1]);
            symbol!($behaviour, "nTangentOperatorBlocks", BLOCK_NAME_COUNT: u16 = 2);
            symbol!(
                $behaviour,
                "TangentOperatorBlocks",
                BLOCKS: [Text; 2] = [text(c"Stress"), text(c"DeformationGradient")]
            );

            symbol!($behaviour, "nMaterialProperties", PROPERTY_COUNT: u16 = PROPERTIES as u16);
            symbol!($behaviour, "MaterialProperties", PROPERTY_LIST: [Text; PROPERTIES] = texts(&PROPERTY_NAMES));
            symbol!($behaviour, "nInternalStateVariables", STATE_COUNT: u16 = STATE as u16);
            symbol!($behaviour, "InternalStateVariables", STATE_LIST: [Text; STATE] = texts(&STATE_NAMES));
            symbol!($behaviour, "InternalStateVariablesTypes", STATE_TYPES: [i32; STATE] = [0; STATE]);
            symbol!($behaviour, "ComputesInternalEnergy", STORES_ENERGY: u16 = 1);
            symbol!($behaviour, "ComputesDissipatedEnergy", DISSIPATES_ENERGY: u16 = 0);

            // None of these; the lists must exist all the same. MGIS and MTest themselves add the temperature.
            symbol!($behaviour, "nExternalStateVariables", EXTERNAL_COUNT: u16 = 0);
            symbol!($behaviour, "ExternalStateVariables", EXTERNAL_LIST: [Text; 1] = [Text::NONE]);
            symbol!($behaviour, "ExternalStateVariablesTypes", EXTERNAL_TYPES: [i32; 1] = [0]);
            symbol!($behaviour, "TemperatureRemovedFromExternalStateVariables", TEMPERATURE_REMOVED: u16 = 1);
            symbol!($behaviour, "nParameters", PARAMETER_COUNT: u16 = 0);
            symbol!($behaviour, "Parameters", PARAMETER_LIST: [Text; 1] = [Text::NONE]);
            symbol!($behaviour, "ParametersTypes", PARAMETER_TYPES: [i32; 1] = [0]);
            symbol!($behaviour, "nInitializeFunctions", INITIALIZER_COUNT: u16 = 0);
            symbol!($behaviour, "nPostProcessings", POST_PROCESSING_COUNT: u16 = 0);

            /// What a host does about values out of bounds: 0 nothing, 1 a warning, 2 an error. It has no effect: properties out of
            /// bounds are always refused, since the law has no meaning there, and no variable has bounds.
            #[unsafe(export_name = concat!($behaviour, "_setOutOfBoundsPolicy"))]
            pub extern "C" fn set_out_of_bounds_policy(_policy: i32) {}

            #[cfg(target_arch = "x86_64")]
            const _: () = assert!(have_bounds($law.properties, &[$($property),*]), "the list of properties with bounds");
            $(
                #[cfg(target_arch = "x86_64")]
                bound!($behaviour, $property, "Lower", bounds($law.properties, $property)[0]);
                #[cfg(target_arch = "x86_64")]
                bound!($behaviour, $property, "Upper", bounds($law.properties, $property)[1]);
            )*
        }
    };
}

behaviour! {
    hyperelastic, "ToronHyperelastic", toron::law::description::HYPERELASTIC,
    bounds of "k_el", "k_tc", "p", "k_td", "k_ld", "eps_lim", "alpha", "beta"
}
behaviour! {
    linear_elastic, "ToronLinearElastic", toron::law::description::LINEAR_ELASTIC,
    bounds of "e_1", "e_2", "g", "sigma_lim"
}

/// The hyperelastic law in three dimensions.
///
/// # Safety
/// MGIS's promise: `view` points to the data of a call, whose arrays have the sizes that the symbols tell.
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // MFront's names, here and below
pub unsafe extern "C" fn ToronHyperelastic_Tridimensional(view: *mut BehaviourDataView) -> i32 {
    // SAFETY: MGIS's promise.
    unsafe { toron::host::mgis::hyperelastic(view) }
}

/// The hyperelastic law in plane strain.
///
/// # Safety
/// As above.
#[unsafe(no_mangle)]
#[allow(non_snake_case)]
pub unsafe extern "C" fn ToronHyperelastic_PlaneStrain(view: *mut BehaviourDataView) -> i32 {
    // SAFETY: MGIS's promise.
    unsafe { toron::host::mgis::hyperelastic_in_plane(view) }
}

/// The hyperelastic law of a body of revolution: radius, axis, circumference.
///
/// # Safety
/// As above.
#[unsafe(no_mangle)]
#[allow(non_snake_case)]
pub unsafe extern "C" fn ToronHyperelastic_Axisymmetrical(view: *mut BehaviourDataView) -> i32 {
    // SAFETY: MGIS's promise.
    unsafe { toron::host::mgis::hyperelastic_in_plane(view) }
}

/// The linear elastic law in three dimensions.
///
/// # Safety
/// As above.
#[unsafe(no_mangle)]
#[allow(non_snake_case)]
pub unsafe extern "C" fn ToronLinearElastic_Tridimensional(view: *mut BehaviourDataView) -> i32 {
    // SAFETY: MGIS's promise.
    unsafe { toron::host::mgis::linear_elastic(view) }
}

/// The linear elastic law in plane strain.
///
/// # Safety
/// As above.
#[unsafe(no_mangle)]
#[allow(non_snake_case)]
pub unsafe extern "C" fn ToronLinearElastic_PlaneStrain(view: *mut BehaviourDataView) -> i32 {
    // SAFETY: MGIS's promise.
    unsafe { toron::host::mgis::linear_elastic_in_plane(view) }
}

/// The linear elastic law of a body of revolution: radius, axis, circumference.
///
/// # Safety
/// As above.
#[unsafe(no_mangle)]
#[allow(non_snake_case)]
pub unsafe extern "C" fn ToronLinearElastic_Axisymmetrical(view: *mut BehaviourDataView) -> i32 {
    // SAFETY: MGIS's promise.
    unsafe { toron::host::mgis::linear_elastic_in_plane(view) }
}
