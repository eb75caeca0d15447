use crate::law::failure::Failure;

#[test]
fn reached_at_exactly_one() {
    assert!(Failure::reached(1.0f64) && !Failure::reached(1.0f64.next_down()));
}
