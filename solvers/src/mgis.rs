//! MGIS, MTest and whatever else loads the libraries that MFront generates: `BEHAVIOUR_HYPOTHESIS` is the function, and
//! `BEHAVIOUR_...` are the data that describe it, the same for all hypotheses. Values that are refused have no symbols
//! here: their names, those of properties, cannot be computed.

#[doc(hidden)]
#[macro_export]
macro_rules! mgis {
    (f64; $($law:ty as $name:literal, user $number:literal;)+) => {
        $(
            const _: () = {
                use $crate::toron::host::mgis::symbols as __toron;

                const LAW: $crate::toron::law::description::Description =
                    <<$law as $crate::toron::host::Material<f64>>::Law as $crate::toron::law::interface::Law<f64>>::DESCRIPTION;
                const PROPERTIES: usize = LAW.properties.len();
                const STATE: usize = LAW.state.len();
                static PROPERTY_NAMES: [[u8; __toron::NAME]; PROPERTIES] = __toron::property_names(LAW.properties);
                static STATE_NAMES: [[u8; __toron::NAME]; STATE] = __toron::state_names(LAW.state);
                const NAME_OF_BEHAVIOUR: &::core::ffi::CStr =
                    match ::core::ffi::CStr::from_bytes_with_nul(concat!($name, "\0").as_bytes()) {
                        Ok(name) => name,
                        Err(_) => c"",
                    };

                // A behaviour of finite strain, from F to the Cauchy stress, isotropic to the host.
                $crate::mgis! { @ $name, "mfront_mkt", MATERIAL_KNOWLEDGE_TYPE: u16 = 1 }
                $crate::mgis! { @ $name, "mfront_interface", INTERFACE: __toron::Text = __toron::Text::new(c"Generic") }
                $crate::mgis! { @ $name, "mfront_ept", ENTRY_POINT: __toron::Text = __toron::Text::new(NAME_OF_BEHAVIOUR) }
                $crate::mgis! { @ $name, "api_version", API_VERSION: u16 = 1 }
                $crate::mgis! { @ $name, "src", SOURCE: __toron::Text = __toron::Text::new(c"toron") }
                $crate::mgis! { @ $name, "BehaviourType", BEHAVIOUR_TYPE: u16 = 2 }
                $crate::mgis! { @ $name, "BehaviourKinematic", KINEMATIC: u16 = 3 }
                $crate::mgis! { @ $name, "SymmetryType", SYMMETRY: u16 = 0 }
                $crate::mgis! { @ $name, "ElasticSymmetryType", ELASTIC_SYMMETRY: u16 = 0 }
                $crate::mgis! { @ $name, "requiresStiffnessTensor", NEEDS_STIFFNESS: u16 = 0 }
                $crate::mgis! { @ $name, "requiresThermalExpansionCoefficientTensor", NEEDS_EXPANSION: u16 = 0 }
                $crate::mgis! { @ $name, "nModellingHypotheses", HYPOTHESIS_COUNT: u16 = 3 }
                $crate::mgis! {
                    @ $name, "ModellingHypotheses", HYPOTHESES: [__toron::Text; 3] =
                        [__toron::Text::new(c"Tridimensional"), __toron::Text::new(c"PlaneStrain"), __toron::Text::new(c"Axisymmetrical")]
                }

                $crate::mgis! { @ $name, "nGradients", GRADIENT_COUNT: u16 = 1 }
                $crate::mgis! { @ $name, "Gradients", GRADIENTS: [__toron::Text; 1] = [__toron::Text::new(c"DeformationGradient")] }
                $crate::mgis! { @ $name, "GradientsTypes", GRADIENT_TYPES: [i32; 1] = [3] }
                $crate::mgis! { @ $name, "nThermodynamicForces", FORCE_COUNT: u16 = 1 }
                $crate::mgis! { @ $name, "ThermodynamicForces", FORCES: [__toron::Text; 1] = [__toron::Text::new(c"Stress")] }
                $crate::mgis! { @ $name, "ThermodynamicForcesTypes", FORCE_TYPES: [i32; 1] = [1] }
                $crate::mgis! { @ $name, "nTangentOperatorBlocks", BLOCK_NAME_COUNT: u16 = 2 }
                $crate::mgis! {
                    @ $name, "TangentOperatorBlocks", BLOCKS: [__toron::Text; 2] =
                        [__toron::Text::new(c"Stress"), __toron::Text::new(c"DeformationGradient")]
                }

                $crate::mgis! { @ $name, "nMaterialProperties", PROPERTY_COUNT: u16 = PROPERTIES as u16 }
                $crate::mgis! {
                    @ $name, "MaterialProperties", PROPERTY_LIST: [__toron::Text; PROPERTIES] = __toron::texts(&PROPERTY_NAMES)
                }
                $crate::mgis! { @ $name, "nInternalStateVariables", STATE_COUNT: u16 = STATE as u16 }
                $crate::mgis! { @ $name, "InternalStateVariables", STATE_LIST: [__toron::Text; STATE] = __toron::texts(&STATE_NAMES) }
                $crate::mgis! { @ $name, "InternalStateVariablesTypes", STATE_TYPES: [i32; STATE] = [0; STATE] }
                $crate::mgis! { @ $name, "ComputesInternalEnergy", STORES_ENERGY: u16 = 1 }
                $crate::mgis! { @ $name, "ComputesDissipatedEnergy", DISSIPATES_ENERGY: u16 = LAW.lost.is_some() as u16 }

                // None of these; the lists must exist all the same. MGIS and MTest themselves add the temperature,
                // which comes first unless it is said to be removed.
                $crate::mgis! { @ $name, "nExternalStateVariables", EXTERNAL_COUNT: u16 = 0 }
                $crate::mgis! { @ $name, "ExternalStateVariables", EXTERNAL_LIST: [__toron::Text; 1] = [__toron::Text::NONE] }
                $crate::mgis! { @ $name, "ExternalStateVariablesTypes", EXTERNAL_TYPES: [i32; 1] = [0] }
                $crate::mgis! { @ $name, "TemperatureRemovedFromExternalStateVariables", TEMPERATURE_REMOVED: u16 = !LAW.reads.temperature as u16 }
                $crate::mgis! { @ $name, "nParameters", PARAMETER_COUNT: u16 = 0 }
                $crate::mgis! { @ $name, "Parameters", PARAMETER_LIST: [__toron::Text; 1] = [__toron::Text::NONE] }
                $crate::mgis! { @ $name, "ParametersTypes", PARAMETER_TYPES: [i32; 1] = [0] }
                $crate::mgis! { @ $name, "nInitializeFunctions", INITIALIZER_COUNT: u16 = 0 }
                $crate::mgis! { @ $name, "nPostProcessings", POST_PROCESSING_COUNT: u16 = 0 }

                /// What a host does about values out of bounds: 0 nothing, 1 a warning, 2 an error. It has no effect:
                /// properties out of bounds are always refused, since the law has no meaning there, and no variable has
                /// bounds.
                #[unsafe(export_name = concat!($name, "_setOutOfBoundsPolicy"))]
                pub extern "C" fn set_out_of_bounds_policy(_policy: i32) {}

                /// The law in three dimensions.
                ///
                /// # Safety
                /// MGIS's promise: `view` points to the data of a call, whose arrays have the sizes that the symbols
                /// tell.
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
