//! What `toron fit` makes of sections that slide: µ and the cohesion of the law with friction.

use approx::assert_relative_eq;

use toron_parameters::identify::file::Job;
use toron_parameters::identify::{output, report};
use toron_test_support::library::folder;

/// q = 0.2 p_t + 0.5 beside a dilatancy of 0.1, at two pressures; with free sides q = p_t = 0.5/0.8.
#[test]
fn sections_that_slide_make_a_preset_of_the_law_with_friction() {
    let place = folder("fit-sliding");
    let table = |name: &str, pressure: f64| {
        let line = |i: usize| {
            let i_td = 0.001 * i as f64;
            format!("{},{},{},{i_td}\n", pressure, 0.3 * pressure + 0.5, 0.1 * i_td)
        };
        let lines: String = (0..=200).map(line).collect();
        std::fs::write(place.join(name), format!("p_t (MPa),q (MPa),I_tc (-),I_td (-)\n{lines}")).expect("a file");
    };
    table("low.csv", 5.0);
    table("high.csv", 20.0);
    table("free.csv", 0.625);
    let file = place.join("fit.toml");
    let read = |sets: &[(&str, &str)]| {
        let sets =
            sets.iter().map(|(name, loading)| format!("[[data]]\nfile = \"{name}.csv\"\nloading = \"{loading}\"\n"));
        let head = "title = \"A section that slides\"\nunits = \"mm-tonne-s\"\n[yarn]\npreset = \"kevlar-km2-600\"\n";
        std::fs::write(&file, head.to_string() + &sets.collect::<String>()).expect("a file");
        Job::read(&file)
    };
    let job = read(&[("low", "biaxial"), ("high", "biaxial"), ("free", "plates")]).expect("it is valid");
    let [mu, c] = [job.friction.mu, job.friction.c].map(|told| told.expect("it is told").value);
    assert_relative_eq!(mu, 0.2, max_relative = 1e-6);
    assert_relative_eq!(c, 0.5, max_relative = 1e-6);
    let fit = job.problem.fit().expect("nothing is left to fit");
    let preset = output::preset(&job, &fit);
    for line in ["law = \"frictional\"", "k_tc = 1055", "mu = 0.2", "cohesion = 0.5"] {
        let number =
            |text: &str| text.split(" = ").nth(1).and_then(|value| value.split(' ').next()?.parse::<f64>().ok());
        let key = line.split(" = ").next().expect("a key");
        let found = preset.lines().find(|found| found.starts_with(&format!("{key} = "))).expect(key);
        let same = number(line).zip(number(found)).is_some_and(|(a, b)| (a / b - 1.0).abs() < 1e-6);
        assert!(same || found.starts_with(line), "{found} instead of {line}");
    }
    let said = report::report(&job, &fit);
    assert!(said.contains("c/(1 − mu)") && said.contains("cohesion"), "{said}");
    let error = read(&[("free", "plates")]).expect_err("mu is missing").to_string();
    assert!(error.contains("fit.toml:5") && error.contains("missing: data with loading = \"biaxial\""), "{error}");
    let said = report::report(&read(&[("low", "biaxial")]).expect("it is valid"), &fit);
    assert!(said.contains("these data are of one pressure"), "{said}");
}
