//! The tangents of the hyperelastic law.

mod common;

use std::collections::BTreeMap;

use common::truth::cases;
use toron::law::hyperelastic::Hyperelastic;
use toron::law::status;
use toron::law::tangent::Measure;

#[test]
fn truth() {
    let mut worst = BTreeMap::<_, f64>::new();
    for case in cases() {
        let law = Hyperelastic::<f64>::new(&case.properties()).expect("valid properties");
        let (point, tangent) = law.tangent(&case.deformation_gradient(), Measure::Jaumann);
        assert_eq!(point.status, status::OK, "case {}", case.id);
        let Some(error) = case.tangent_error(&tangent) else { continue };
        let worst = worst.entry(case.category).or_default();
        *worst = worst.max(error);
    }
    for (category, error) in worst {
        println!("{category:<20} {error:.1e}");
    }
}
