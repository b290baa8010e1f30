//! The page of the seeded faults: which check of which case sees which.

use crate::cases;
use crate::report::document::{Cell, Document, Row, Table, Text, prose};
use crate::report::faults::{Seen, hangs_on_one};
use crate::study::summary::Summary;
use std::collections::BTreeMap;

/// A line a fault and a column a case that sees any, in the order of the cases; a case has a link where it has a page.
pub(super) fn page(faults: &BTreeMap<String, Seen>, summary: &Summary) -> Document {
    let sees = |case: &str| faults.values().filter(|seen| seen.contains_key(case)).count();
    let names: Vec<&str> = cases::all().iter().map(|case| case.name).filter(|name| sees(name) > 0).collect();
    let title = |name: &&str| match summary.cases.iter().any(|study| study.case == **name) {
        true => Cell::of(Text::link(*name, format!("{name}.html#checks")), "steep"),
        false => Cell::of(*name, "steep"),
    };
    let line = |(fault, seen): (&String, &Seen)| -> Row {
        let class = if hangs_on_one(seen) { "known" } else { "pass" };
        let cells = names.iter().map(|name| match seen.get(*name) {
            Some(checks) => Cell::of(checks.len().to_string(), class).titled(checks.join(", ")),
            None => Cell::default(),
        });
        [Cell::head(&**fault)].into_iter().chain(cells).into()
    };
    let seen = names.iter().map(|name| sees(name).to_string().into());
    let last = [Cell::head("faults that a case sees")].into_iter().chain(seen).into();
    let table = Table {
        class: "map faults",
        head: ["fault".into()].into_iter().chain(names.iter().map(title)).collect(),
        rows: faults.iter().map(line).chain([last]).collect(),
    };
    let alone = faults.values().filter(|seen| hangs_on_one(seen)).count();
    let mut page = Document::new("Seeded faults and the checks that detect them");
    page.classed(
        "lead",
        format!(
            "{} faults of physics were put into the code on purpose, one at a time. Every one turns a check red; {alone} hang \
             on one check alone.",
            faults.len()
        ),
    );
    let key = Text::from("A number is that of the checks of a case that go red, which its title names. ");
    page.paragraph(
        key.then(Text::mark("3", "key pass"))
            .then(" others detect the fault too · ")
            .then(Text::mark("1", "key known"))
            .then(" nothing else detects it: the fault would be lost with that check."),
    );
    page.table("Faults and cases", table);
    prose("faults").for_each(|text| page.note(text));
    page
}
