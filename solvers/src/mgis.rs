//! MGIS, MTest and whatever else loads the libraries that MFront generates: `BEHAVIOUR_HYPOTHESIS` is the function, and `BEHAVIOUR_...`
//! are the data that describe it, the same for all hypotheses. Values that are refused have no symbols here: their names, those of
//! properties, cannot be computed.

#[doc(hidden)]
#[macro_export]
macro_rules! mgis {
    (f64; $($law:ty as $name:literal, user $number:literal;)+) => {
        $(
            const _: () = {
                const PROPERTIES: usize = $crate::description!($law, f64).properties.len();
                const STATE: usize = $crate::description!($law, f64).state.len();
                static PROPERTY_NAMES: [[u8; $crate::toron::host::mgis::symbols::NAME]; PROPERTIES] =
                    $crate::toron::host::mgis::symbols::property_names($crate::description!($law, f64).properties);
                static STATE_NAMES: [[u8; $crate::toron::host::mgis::symbols::NAME]; STATE] =
                    $crate::toron::host::mgis::symbols::state_names($crate::description!($law, f64).state);
                const NAME_OF_BEHAVIOUR: &::core::ffi::CStr =
                    match ::core::ffi::CStr::from_bytes_with_nul(concat!($name, "\0").as_bytes()) {
                        Ok(name) => name,
                        Err(_) => c"",
                    };

                // A behaviour of finite strain, from F to the Cauchy stress, isotropic to the host.
                $crate::mgis! { @ $name, "mfront_mkt", MATERIAL_KNOWLEDGE_TYPE: u16 = 1 }
                $crate::mgis! { @ $name, "mfront_interface", INTERFACE: $crate::toron::host::mgis::symbols::Text = $crate::toron::host::mgis::symbols::Text::new(c"Generic") }
                $crate::mgis! { @ $name, "mfront_ept", ENTRY_POINT: $crate::toron::host::mgis::symbols::Text = $crate::toron::host::mgis::symbols::Text::new(NAME_OF_BEHAVIOUR) }
                $crate::mgis! { @ $name, "api_version", API_VERSION: u16 = 1 }
                $crate::mgis! { @ $name, "src", SOURCE: $crate::toron::host::mgis::symbols::Text = $crate::toron::host::mgis::symbols::Text::new(c"toron") }
                $crate::mgis! { @ $name, "BehaviourType", BEHAVIOUR_TYPE: u16 = 2 }
                $crate::mgis! { @ $name, "BehaviourKinematic", KINEMATIC: u16 = 3 }
                $crate::mgis! { @ $name, "SymmetryType", SYMMETRY: u16 = 0 }
                $crate::mgis! { @ $name, "ElasticSymmetryType", ELASTIC_SYMMETRY: u16 = 0 }
                $crate::mgis! { @ $name, "requiresStiffnessTensor", NEEDS_STIFFNESS: u16 = 0 }
                $crate::mgis! { @ $name, "requiresThermalExpansionCoefficientTensor", NEEDS_EXPANSION: u16 = 0 }
                $crate::mgis! { @ $name, "nModellingHypotheses", HYPOTHESIS_COUNT: u16 = 3 }
                $crate::mgis! {
                    @ $name, "ModellingHypotheses", HYPOTHESES: [$crate::toron::host::mgis::symbols::Text; 3] =
                        [$crate::toron::host::mgis::symbols::Text::new(c"Tridimensional"), $crate::toron::host::mgis::symbols::Text::new(c"PlaneStrain"), $crate::toron::host::mgis::symbols::Text::new(c"Axisymmetrical")]
                }

                $crate::mgis! { @ $name, "nGradients", GRADIENT_COUNT: u16 = 1 }
                $crate::mgis! { @ $name, "Gradients", GRADIENTS: [$crate::toron::host::mgis::symbols::Text; 1] = [$crate::toron::host::mgis::symbols::Text::new(c"DeformationGradient")] }
                $crate::mgis! { @ $name, "GradientsTypes", GRADIENT_TYPES: [i32; 1] = [3] }
                $crate::mgis! { @ $name, "nThermodynamicForces", FORCE_COUNT: u16 = 1 }
                $crate::mgis! { @ $name, "ThermodynamicForces", FORCES: [$crate::toron::host::mgis::symbols::Text; 1] = [$crate::toron::host::mgis::symbols::Text::new(c"Stress")] }
                $crate::mgis! { @ $name, "ThermodynamicForcesTypes", FORCE_TYPES: [i32; 1] = [1] }
                $crate::mgis! { @ $name, "nTangentOperatorBlocks", BLOCK_NAME_COUNT: u16 = 2 }
                $crate::mgis! {
                    @ $name, "TangentOperatorBlocks", BLOCKS: [$crate::toron::host::mgis::symbols::Text; 2] =
                        [$crate::toron::host::mgis::symbols::Text::new(c"Stress"), $crate::toron::host::mgis::symbols::Text::new(c"DeformationGradient")]
                }

                $crate::mgis! { @ $name, "nMaterialProperties", PROPERTY_COUNT: u16 = PROPERTIES as u16 }
                $crate::mgis! {
                    @ $name, "MaterialProperties", PROPERTY_LIST: [$crate::toron::host::mgis::symbols::Text; PROPERTIES] = $crate::toron::host::mgis::symbols::texts(&PROPERTY_NAMES)
                }
                $crate::mgis! { @ $name, "nInternalStateVariables", STATE_COUNT: u16 = STATE as u16 }
                $crate::mgis! { @ $name, "InternalStateVariables", STATE_LIST: [$crate::toron::host::mgis::symbols::Text; STATE] = $crate::toron::host::mgis::symbols::texts(&STATE_NAMES) }
                $crate::mgis! { @ $name, "InternalStateVariablesTypes", STATE_TYPES: [i32; STATE] = [0; STATE] }
                $crate::mgis! { @ $name, "ComputesInternalEnergy", STORES_ENERGY: u16 = 1 }
                $crate::mgis! { @ $name, "ComputesDissipatedEnergy", DISSIPATES_ENERGY: u16 = 0 }

                // None of these; the lists must exist all the same. MGIS and MTest themselves add the temperature.
                $crate::mgis! { @ $name, "nExternalStateVariables", EXTERNAL_COUNT: u16 = 0 }
                $crate::mgis! { @ $name, "ExternalStateVariables", EXTERNAL_LIST: [$crate::toron::host::mgis::symbols::Text; 1] = [$crate::toron::host::mgis::symbols::Text::NONE] }
                $crate::mgis! { @ $name, "ExternalStateVariablesTypes", EXTERNAL_TYPES: [i32; 1] = [0] }
                $crate::mgis! { @ $name, "TemperatureRemovedFromExternalStateVariables", TEMPERATURE_REMOVED: u16 = 1 }
                $crate::mgis! { @ $name, "nParameters", PARAMETER_COUNT: u16 = 0 }
                $crate::mgis! { @ $name, "Parameters", PARAMETER_LIST: [$crate::toron::host::mgis::symbols::Text; 1] = [$crate::toron::host::mgis::symbols::Text::NONE] }
                $crate::mgis! { @ $name, "ParametersTypes", PARAMETER_TYPES: [i32; 1] = [0] }
                $crate::mgis! { @ $name, "nInitializeFunctions", INITIALIZER_COUNT: u16 = 0 }
                $crate::mgis! { @ $name, "nPostProcessings", POST_PROCESSING_COUNT: u16 = 0 }

                /// What a host does about values out of bounds: 0 nothing, 1 a warning, 2 an error. It has no effect: properties out
                /// of bounds are always refused, since the law has no meaning there, and no variable has bounds.
                #[unsafe(export_name = concat!($name, "_setOutOfBoundsPolicy"))]
                pub extern "C" fn set_out_of_bounds_policy(_policy: i32) {}

                /// The law in three dimensions.
                ///
                /// # Safety
                /// MGIS's promise: `view` points to the data of a call, whose arrays have the sizes that the symbols tell.
                #[unsafe(export_name = concat!($name, "_Tridimensional"))]
                pub unsafe extern "C" fn tridimensional(view: *mut $crate::toron::host::mgis::BehaviourDataView) -> i32 {
                    // SAFETY: the view is MGIS's.
                    unsafe { <<$law as $crate::toron::host::Material<f64>>::Law as $crate::toron::host::mgis::MgisLaw>::integrate(view) }
                }

                /// The law in plane strain.
                ///
                /// # Safety
                /// As above.
                #[unsafe(export_name = concat!($name, "_PlaneStrain"))]
                pub unsafe extern "C" fn plane_strain(view: *mut $crate::toron::host::mgis::BehaviourDataView) -> i32 {
                    // SAFETY: the view is MGIS's.
                    unsafe { <<$law as $crate::toron::host::Material<f64>>::Law as $crate::toron::host::mgis::MgisLaw>::integrate_in_plane(view) }
                }

                /// The law of a body of revolution: radius, axis, circumference.
                ///
                /// # Safety
                /// As above.
                #[unsafe(export_name = concat!($name, "_Axisymmetrical"))]
                pub unsafe extern "C" fn axisymmetrical(view: *mut $crate::toron::host::mgis::BehaviourDataView) -> i32 {
                    // SAFETY: the view is MGIS's.
                    unsafe { <<$law as $crate::toron::host::Material<f64>>::Law as $crate::toron::host::mgis::MgisLaw>::integrate_in_plane(view) }
                }
            };
        )+
    };
    // MFront's loaders compute in double precision.
    (f32; $($list:tt)+) => {};
    // A data symbol: the behaviour's name and the rest of the symbol's name, its type and its value.
    (@ $behaviour:literal, $name:literal, $static:ident: $type:ty = $value:expr) => {
        #[unsafe(export_name = concat!($behaviour, "_", $name))]
        pub static $static: $type = $value;
    };
}
