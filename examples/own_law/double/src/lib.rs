//! The reinforced and the viscoelastic solid for every solver whose real numbers are of double precision.

toron_solvers::export! {
    f64;
    reinforced_solid::ReinforcedSolid as "REINFORCED", user 3;
    reinforced_solid::viscoelastic::ViscoelasticSolid as "VISCOELASTIC", user 4;
}
