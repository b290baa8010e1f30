//! Speed against error of all problems: what a target error costs with each remedy, and when F̄ is worth its price.

use super::prelude::*;
use super::price::{Price, Prices};
use crate::draw::{Ratios, draw_ratios};

/// Standard MPM, and the F̄ that neither creeps nor makes energy: the two to choose from. The others are there for
/// comparison.
const STANDARD: RemedyName = RemedyName::None;
const OURS: RemedyName = RemedyName::FbarConsistent;
/// Least number of motions for a meaningful median.
const FEW: usize = 3;
/// Name of the picture, and of the table on pages.
pub(super) const NAME: &str = "speed-against-error";

/// The prices of all problems that have any.
pub(super) struct Speed(Vec<(&'static str, Prices)>);

impl Speed {
    pub(super) fn of<'a>(studies: impl IntoIterator<Item = &'a CaseStudy>) -> Self {
        let prices = studies.into_iter().flat_map(|study| {
            let title = cases::find(&study.case).map_or("", |case| case.title);
            Prices::of(study).into_iter().map(move |p| (title, p))
        });
        Self(prices.collect())
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// A row a problem and error: the target, what it costs with the cheapest scheme, and how many times as many
    /// particle–node pairs with the cheapest of each remedy.
    pub(super) fn table(&self) -> Sheet {
        let all = self.0.iter().flat_map(|(_, prices)| &prices.rows);
        let mut remedies = distinct(all.map(|row| row.scheme.remedy()));
        remedies.sort_unstable();
        let row = |(title, prices): &(&str, Prices)| {
            let first = &prices.rows[0];
            let [pairs, cpu] = first.shown();
            let of = format!("{} {}", prices.label, prices.aim());
            let ratio = |remedy: &RemedyName| match prices.cheapest(*remedy) {
                Some(own) => prices.relative(own),
                None if prices.has(*remedy) => "never".to_owned(),
                None => "–".to_owned(),
            };
            let row = [(*title).to_owned(), of, first.name(), pairs, cpu];
            row.into_iter().chain(remedies.iter().map(ratio)).collect()
        };
        let head = ["problem", "target: error", "cheapest scheme", "pairs (10⁶)", "CPU (s)"];
        Sheet::new(head.into_iter().chain(remedies.iter().map(|r| r.text()))).with(self.0.iter().map(row))
    }

    /// The median over all motions of what the target error costs with a scheme, over what it costs with the cheapest, and
    /// in how many of those in which it was run it gets there; empty if it was run in fewer than [`FEW`].
    pub(super) fn median(&self, scheme: Scheme) -> String {
        let motions = self.0.iter().map(|(_, p)| p).filter(|p| !p.of_stress);
        let rows: Vec<(&Prices, &Price)> =
            motions.filter_map(|p| Some((p, p.rows.iter().find(|row| row.scheme == scheme)?))).collect();
        let mut ratios: Vec<f64> = rows.iter().filter_map(|(p, row)| p.over_cheapest(row)).collect();
        ratios.sort_by(f64::total_cmp);
        match (rows.len(), ratios.len()) {
            (all, _) if all < FEW => String::new(),
            (all, 0) => format!("never (0/{all})"),
            (all, n) => {
                let median = 0.5 * (ratios[(n - 1) / 2] + ratios[n / 2]);
                format!("{median:.1} ({n}/{all})")
            }
        }
    }

    /// When F̄ is worth its price, and which scheme to take.
    pub(super) fn advice(&self) -> String {
        let [motion, stress] = [false, true].map(|of_stress| {
            let is_worth_it = |ratio: f64| ratio < 1.0;
            let worth = |(_, p): &&(&str, Prices)| p.of_stress == of_stress && ratio(p).is_some_and(is_worth_it);
            list(self.0.iter().filter(worth).map(|(title, _)| *title))
        });
        let motions = self.0.iter().filter(|(_, p)| !p.of_stress);
        let mut elsewhere: Vec<f64> = motions.filter_map(|(_, p)| ratio(p)).collect();
        elsewhere.retain(|ratio| *ratio >= 1.0 && ratio.is_finite());
        elsewhere.sort_by(f64::total_cmp);
        let dearer = match (elsewhere.first(), elsewhere.last()) {
            (Some(least), Some(most)) => format!(
                "For the motion elsewhere it costs {least:.1} to {most:.1} times as much as standard MPM: do without. "
            ),
            _ => String::new(),
        };
        let never = |remedy: RemedyName, name: &str| {
            let not = |(_, p): &&(&str, Prices)| p.has(remedy) && p.cheapest(remedy).is_none();
            let what = |p: &Prices| if p.of_stress { "pressure" } else { "motion" };
            let titles = self.0.iter().filter(not).map(|(title, p)| format!("{title} ({})", what(p)));
            format!("{name} never reaches the target in: {}.", list(titles))
        };
        format!(
            "Take F̄ ({OURS}) for the motion in: {motion}; for the pressure in: {stress}. There it is cheaper than \
             standard MPM for the same error, or alone in reaching it. {dearer}Best basis of F̄: {}; of standard MPM: {}. {} {} \
             The other F̄ are there for comparison: they creep or make energy.",
            self.basis(OURS),
            self.basis(STANDARD),
            never(STANDARD, "Standard MPM"),
            never(OURS, "F̄")
        )
    }

    /// The basis with which a remedy reaches most targets at the least cost.
    fn basis(&self, remedy: RemedyName) -> String {
        let of_all = self.0.iter().filter_map(|(_, p)| Some(p.cheapest(remedy)?.scheme.basis())).collect::<Vec<_>>();
        let count = |basis: &BasisName| of_all.iter().filter(|b| *b == basis).count();
        distinct(of_all.iter().copied()).into_iter().max_by_key(count).map_or_else(
            || "–".to_owned(),
            |basis| format!("{basis} (the cheapest on {} of {})", count(&basis), of_all.len()),
        )
    }

    /// Draws what F̄ costs over what standard MPM costs.
    pub(super) fn draw(&self, out: &Path) -> Result<Option<Picture>, Error> {
        let row = |title: &&'static str| {
            let of = |of_stress| {
                let mut own = self.0.iter().filter(|(of, p)| of == title && p.of_stress == of_stress);
                own.next().and_then(|(_, p)| ratio(p))
            };
            ((*title).to_owned(), vec![of(false), of(true)])
        };
        let mut rows: Vec<_> = distinct(self.0.iter().map(|(title, _)| *title)).iter().map(row).collect();
        rows.retain(|(_, ratios)| ratios.iter().any(Option::is_some));
        if rows.is_empty() {
            return Ok(None);
        }
        let ratios = Ratios {
            title: "fbar-consistent over no remedy: particle–node pairs for the same error".to_owned(),
            sides: ["fbar-consistent is cheaper", "no remedy is cheaper"].map(str::to_owned),
            ends: ["no remedy never gets there", "fbar-consistent never"].map(str::to_owned),
            kinds: ["error of the motion", "error of the pressure"].map(str::to_owned).to_vec(),
            rows,
        };
        let file = format!("{NAME}.png");
        draw_ratios(&out.join(&file), &ratios)?;
        let caption = format!(
            "Particle–node pairs of the cheapest scheme with {OURS} over those of the cheapest without a remedy, to the \
             error that half of all schemes reach. At the ends: only one of the two reaches it."
        );
        Ok(Some(Picture { file, caption }))
    }
}

/// Ratio of the cost of F̄ to that of standard MPM, if both have been run and one reaches the target; a scheme that misses
/// the target costs infinitely much.
fn ratio(prices: &Prices) -> Option<f64> {
    if !(prices.has(OURS) && prices.has(STANDARD)) {
        return None;
    }
    let pairs = |remedy| prices.cheapest(remedy)?.cost.map(|cost| cost.pairs);
    match (pairs(OURS), pairs(STANDARD)) {
        (None, None) => None,
        (ours, standard) => Some(ours.unwrap_or(f64::INFINITY) / standard.unwrap_or(f64::INFINITY)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::fixture;

    /// Cook's membrane, where standard MPM never comes near and the pressure takes F̄ more.
    fn cook() -> CaseStudy {
        let run = |remedy, level: &str, (h, pairs): (f64, u64), errors: [f64; 2]| {
            let errors = [("fem_edge_mean_error", errors[0]), ("mean_stress_rms_error", errors[1])];
            let mut run = fixture::run(&[], (BasisName::Gimp, remedy), (level, h), &[], &errors);
            run.work.particle_node_pairs = pairs;
            run
        };
        let runs = [
            run(STANDARD, "h2", (2.0, 100), [0.5, 0.4]),
            run(STANDARD, "h1", (1.0, 400), [0.4, 0.1]),
            run(OURS, "h2", (2.0, 400), [0.2, 0.4]),
            run(OURS, "h1", (1.0, 1600), [0.05, 0.1]),
        ];
        CaseStudy::new("cook", runs.to_vec())
    }

    #[test]
    fn the_price_of_a_remedy_is_that_of_the_motion_and_that_of_the_pressure() {
        let mut study = cook();
        // What half reach is what the worse of two reaches.
        study.records[3].measure(&[("fem_edge_mean_error", 0.45)]);
        let speed = Speed::of([&study]);
        let rows = speed.table().rows;
        assert_eq!(rows.len(), 2);
        assert_eq!(rows[1][..3], ["Cook's membrane", "rms error of σ_m (Pa) 0.1", "gimp none"]);
        assert_eq!(rows[1][5..], ["1.0", "4.0"]);
    }

    #[test]
    fn a_median_is_of_three_motions_at_least() {
        let study = cook();
        let ours = Scheme::flip(BasisName::Gimp, OURS);
        let median = |motions: usize| Speed::of(vec![&study; motions]).median(ours);
        assert_eq!(median(2), "");
        // The target is what half of the schemes reach, the motion of F̄ at h2: alone in reaching it, it is the cheapest.
        assert_eq!(median(3), "1.0 (3/3)");
    }

    #[test]
    fn the_advice_follows_from_the_prices() {
        let speed = Speed::of([&cook()]);
        let advice = speed.advice();
        assert!(
            advice.starts_with("Take F̄ (fbar-consistent) for the motion in: none; for the pressure in: none."),
            "{advice}"
        );
        let folder = tempfile::tempdir().unwrap();
        let picture = speed.draw(folder.path()).unwrap().unwrap();
        assert!(folder.path().join(picture.file).with_extension("svg").exists());
        assert!(Speed::of([]).draw(folder.path()).unwrap().is_none());
    }
}
