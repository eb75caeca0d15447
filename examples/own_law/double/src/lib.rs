//! The reinforced, the viscoelastic and the plastic solid for every solver whose real numbers are of double precision.

toron_solvers::export! {
    f64;
    reinforced_solid::ReinforcedSolid as "REINFORCED", user 3;
    reinforced_solid::viscoelastic::ViscoelasticSolid as "VISCOELASTIC", user 4;
    reinforced_solid::plastic::PlasticSolid as "PLASTIC", user 5;
}
