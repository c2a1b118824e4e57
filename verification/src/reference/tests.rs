//! A data set that was tampered with is refused, and the error says where.

use super::*;

const GOOD: &str = "t [s],p [Pa]\n0,1.5\n0.5,-2\n1,3\n";

fn data(text: &'static str, ascent: Ascent) -> DataSet {
    DataSet { path: "made-up/set.csv", text, columns: &["t [s]", "p [Pa]"], ascent }
}

fn complaint(text: &'static str) -> String {
    data(text, Ascent::Strict).parse().expect_err("refused").to_string()
}

#[test]
fn values_are_read_as_they_stand() {
    let table = data(GOOD, Ascent::Strict).parse().expect("read");
    let series = table.series("t [s]", "p [Pa]").expect("columns");
    assert_eq!(series.points, [(0.0, 1.5), (0.5, -2.0), (1.0, 3.0)]);
    let error = table.series("t [s]", "q").expect_err("refused").to_string();
    assert_eq!(error, "made-up/set.csv, heading: q is not allowed; one of t [s], p [Pa]");
}

#[test]
fn errors_name_file_line_field_value_and_what_is_allowed() {
    let place = "made-up/set.csv, line";
    for (text, error) in [
        ("", format!("{place} 1, number of columns: 1 is not allowed; 2 columns are declared")),
        (
            "t [ms],p [Pa]\n0,1\n",
            format!("{place} 1, t [s]: t [ms] is not allowed; the heading is `t [s]`"),
        ),
        (
            "t [s],p [Pa]\n0,1\n1\n",
            format!("{place} 3, number of columns: 1 is not allowed; 2 columns are declared"),
        ),
        (
            "t [s],p [Pa]\n0,NaN\n",
            format!("{place} 2, p [Pa]: NaN is not allowed; a finite number"),
        ),
        (
            "t [s],p [Pa]\n0,1e999\n",
            format!("{place} 2, p [Pa]: 1e999 is not allowed; a finite number"),
        ),
        (
            "t [s],p [Pa]\n0,one\n",
            format!("{place} 2, p [Pa]: one is not allowed; a finite number"),
        ),
        (
            "t [s],p [Pa]\n1,1\n0.5,1\n",
            format!("{place} 3, t [s]: 0.5 is not allowed; above 1 of the line before"),
        ),
    ] {
        assert_eq!(complaint(text), error);
    }
}

#[test]
fn equal_abscissae_need_a_weak_order() {
    let text = "t [s],p [Pa]\n1,1\n1,2\n";
    assert!(data(text, Ascent::Strict).parse().is_err());
    assert!(data(text, Ascent::Weak).parse().is_ok());
    assert!(data("t [s],p [Pa]\n1,1\n0,2\n", Ascent::Weak).parse().is_err());
}

#[test]
fn a_file_without_a_checksum_is_refused() {
    let error = data(GOOD, Ascent::Strict).read().expect_err("refused");
    assert_eq!(error.field, "made-up/set.csv, SHA-256");
    assert_eq!(error.allowed, "SHA256SUMS has no line");
}

#[test]
fn the_checksum_is_that_of_the_standard() {
    // FIPS 180-4, the message "abc".
    assert_eq!(
        hexadecimal(&Sha256::digest(b"abc")),
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
    );
}
