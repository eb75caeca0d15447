//! Which keywords may stand beside a mesh, and which elements.

use toron_shared::error::Error;
use toron_shared::keyword_file::abaqus::Keyword;

/// Keywords that change neither nodes nor elements nor the fibres in them: laws with all that belongs to them, sections
/// of what is no solid, surfaces, contact, constraints, loads, results, and sets of nodes. In a step there are others,
/// which come after the mesh.
const WITHOUT_EFFECT: &str = "
    HEADING PREPRINT RESTART DIAGNOSTICS PHYSICALCONSTANTS WAVEFRONTMINIMIZATION AMPLITUDE TIMEPOINTS FILTER
    MATERIAL DENSITY ELASTIC PLASTIC DEPVAR USERMATERIAL USERDEFINEDFIELD USEROUTPUTVARIABLES HYPERELASTIC HYPERFOAM HYPOELASTIC
    ANISOTROPICHYPERELASTIC VISCOELASTIC VISCOUS CREEP RATEDEPENDENT POTENTIAL CYCLICHARDENING EXPANSION CONDUCTIVITY SPECIFICHEAT
    LATENTHEAT INELASTICHEATFRACTION JOULEHEATFRACTION HEATGENERATION DAMPING DAMAGEINITIATION DAMAGEEVOLUTION DAMAGESTABILIZATION
    FAILSTRESS FAILSTRAIN SHEARFAILURE TENSILEFAILURE EOS EOSCOMPACTION POROUSMETALPLASTICITY VOIDNUCLEATION POROUSFAILURECRITERIA
    DRUCKERPRAGER DRUCKERPRAGERHARDENING CAPPLASTICITY CAPHARDENING CRUSHABLEFOAM CRUSHABLEFOAMHARDENING CLAYPLASTICITY
    CLAYHARDENING MOHRCOULOMB MOHRCOULOMBHARDENING CONCRETE CONCRETEDAMAGEDPLASTICITY BRITTLECRACKING BRITTLESHEAR BRITTLEFAILURE
    FABRIC UNIAXIAL LOADINGDATA UNLOADINGDATA LOWDENSITYFOAM MULLINSEFFECT NOCOMPRESSION NOTENSION UNIAXIALTESTDATA BIAXIALTESTDATA
    PLANARTESTDATA VOLUMETRICTESTDATA SHEARTESTDATA SIMPLESHEARTESTDATA DEFORMATIONPLASTICITY ANNEALTEMPERATURE TRS PERMEABILITY
    SHELLSECTION SHELLGENERALSECTION MEMBRANESECTION BEAMSECTION BEAMGENERALSECTION SURFACESECTION CONNECTORSECTION
    CONNECTORBEHAVIOR CONNECTORELASTICITY CONNECTORDAMPING CONNECTORSTOP CONNECTORLOCK CONNECTORFRICTION CONNECTORFAILURE
    SECTIONCONTROLS HOURGLASSSTIFFNESS TRANSVERSESHEARSTIFFNESS RIGIDBODY MASS ROTARYINERTIA NONSTRUCTURALMASS SPRING DASHPOT
    NSET SURFACE SURFACEPROPERTYASSIGNMENT SURFACEINTERACTION SURFACEBEHAVIOR FRICTION COHESIVEBEHAVIOR CONTACT CONTACTINCLUSIONS
    CONTACTEXCLUSIONS CONTACTPROPERTYASSIGNMENT CONTACTFORMULATION CONTACTCONTROLS CONTACTCONTROLSASSIGNMENT CONTACTPAIR
    CONTACTDAMPING GAPCONDUCTANCE GAPHEATGENERATION
    BOUNDARY INITIALCONDITIONS EQUATION MPC TIE COUPLING KINEMATIC DISTRIBUTING KINEMATICCOUPLING DISTRIBUTINGCOUPLING
    EMBEDDEDELEMENT RELEASE TRANSFORM INTEGRATEDOUTPUTSECTION BULKVISCOSITY ASSEMBLY ENDASSEMBLY";
/// Keywords of a step besides: procedures, loads and results, which come after the mesh.
const IN_A_STEP: &str = "
    ENDSTEP STATIC DYNAMIC VISCO FREQUENCY BUCKLE MODALDYNAMIC STEADYSTATEDYNAMICS COMPLEXFREQUENCY HEATTRANSFER
    COUPLEDTEMPERATUREDISPLACEMENT DYNAMICTEMPERATUREDISPLACEMENT ANNEAL SUBSTRUCTUREGENERATE CONTROLS SOLVERCONTROLS
    FIXEDMASSSCALING VARIABLEMASSSCALING MASSADJUST SELECTCYCLICSYMMETRYMODES MODALDAMPING GLOBALDAMPING
    CLOAD DLOAD DSLOAD DECHARGE DSECHARGE INERTIARELIEF TEMPERATURE FIELD PRESSURESTRESS CFLUX DFLUX DSFLUX FILM SFILM RADIATE
    SRADIATE BASEMOTION CONNECTORMOTION CONNECTORLOAD PRETENSIONSECTION
    OUTPUT NODEOUTPUT ELEMENTOUTPUT ENERGYOUTPUT CONTACTOUTPUT SURFACEOUTPUT INCREMENTATIONOUTPUT RADIATIONOUTPUT
    INTEGRATEDOUTPUT MODALOUTPUT NODEFILE ELFILE ENERGYFILE CONTACTFILE MODALFILE FILEOUTPUT NODEPRINT ELPRINT ENERGYPRINT
    CONTACTPRINT MODALPRINT SECTIONFILE SECTIONPRINT MONITOR PRINT CONTACTINTERFERENCE CHANGEFRICTION CLEARANCE";
/// How the kinds of elements begin that are no volumes: rigid faces, masses, connectors, lines, membranes, shells and
/// plane elements, which are the striker's or a clamp's, or what a mesher writes of surfaces.
const NO_VOLUMES: [&str; 26] = [
    "R3D", "RAX", "R2D", "RB", "MASS", "ROTARYI", "HEATCAP", "CONN", "SPRING", "DASHPOT", "T3D", "T2D", "B2", "B3",
    "PIPE", "S3", "S4", "S6", "S8", "S9", "STRI", "M3D", "SFM3D", "CPS", "CPE", "CAX",
];

/// That a keyword which is not read leaves the mesh as it is.
///
/// # Errors
/// It may not.
pub fn check(keyword: &Keyword<'_>) -> Result<(), Error> {
    let Keyword { line, name, .. } = keyword;
    if !is_one_of(WITHOUT_EFFECT, name) {
        let message = format!(
            "{}; allowed: nodes and elements one by one, *ELSET, *SOLID SECTION, *ORIENTATION, *DISTRIBUTION, *PART, \
             *INSTANCE, *INCLUDE, and keywords that leave nodes, elements and fibres as they are",
            keyword.title()
        );
        return Err(line.error(&message));
    }
    // Nodes that are adjusted are put onto the surface across from them, as *TIE does without the parameter too.
    let adjusts = name == "TIE" || keyword.value("ADJUST").is_some();
    if adjusts && keyword.label("ADJUST").is_none_or(|value| value != "NO") {
        return Err(line.error(&format!("{}, which moves nodes; allowed: ADJUST=NO", keyword.title())));
    }
    Ok(())
}

/// That a keyword in a step comes after the mesh.
///
/// # Errors
/// It does not.
pub fn check_in_step(keyword: &Keyword<'_>) -> Result<(), Error> {
    if is_one_of(IN_A_STEP, &keyword.name) || is_one_of(WITHOUT_EFFECT, &keyword.name) {
        return Ok(());
    }
    let allowed = "procedures, loads and results, and what leaves nodes, elements and fibres as they are";
    Err(keyword.line.error(&format!("{} in a step; allowed: {allowed}", keyword.title())))
}

fn is_one_of(list: &str, name: &str) -> bool {
    list.split_whitespace().any(|other| other == name)
}

/// Nodes of the elements of a keyword; none where they are no volumes.
///
/// # Errors
/// They are volumes of another kind.
pub fn nodes_of(keyword: &Keyword<'_>) -> Result<Option<usize>, Error> {
    let kind = keyword.label("TYPE").unwrap_or_default();
    let variant = |nodes: &str| kind.strip_prefix(nodes).is_some_and(|rest| rest.chars().all(|c| c.is_alphabetic()));
    if variant("C3D8") {
        Ok(Some(8))
    } else if variant("C3D6") {
        Ok(Some(6))
    } else if NO_VOLUMES.iter().any(|begin| kind.starts_with(begin)) {
        Ok(None)
    } else {
        let message =
            format!("elements of type {kind}; allowed: C3D8 and C3D6 and their variants, and what is no volume");
        Err(keyword.line.error(&message))
    }
}
