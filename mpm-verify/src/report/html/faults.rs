//! The page of the seeded faults: which check of which case sees which.

use crate::cases;
use crate::report::faults::Fault;
use crate::study::summary::Summary;
use minijinja::{Value, context};

/// A line a fault and a column a case that sees any, in the order of the cases; a case has a link where it has a page.
pub(super) fn page(faults: &[Fault], summary: &Summary) -> Value {
    let sees = |case: &str| faults.iter().any(|f| f.seen_by.contains_key(case));
    let names = cases::all().iter().map(|case| case.name);
    let names: Vec<&str> = names.filter(|name| sees(name)).collect();
    let has_page = |name: &str| summary.cases.iter().any(|study| study.case == name);
    let columns = names.iter().map(|&name| {
        let seen = faults.iter().filter(|f| f.seen_by.contains_key(name));
        context! { name, has_page => has_page(name), seen => seen.count() }
    });
    let line = |fault: &Fault| {
        let cells = names.iter().map(|name| {
            let checks = fault.seen_by.get(*name)?;
            Some(context! { count => checks.len(), checks => checks.join(", ") })
        });
        let cells: Vec<Option<Value>> = cells.collect();
        context! { name => &fault.name, alone => fault.hangs_on_one(), cells }
    };
    context! {
        tier => &summary.tier,
        all => faults.len(),
        alone => faults.iter().filter(|f| f.hangs_on_one()).count(),
        columns => columns.collect::<Vec<_>>(),
        lines => faults.iter().map(line).collect::<Vec<_>>(),
    }
}
