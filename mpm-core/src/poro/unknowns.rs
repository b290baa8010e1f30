//! The unknowns of a step: components of nodal displacements, and behind them nodal pressures.

use super::pores::Pores;
use crate::implicit::OfHats;
use crate::implicit::elements::Elements;
use crate::implicit::unknowns::Pattern;
use crate::particles::Particles;
use nalgebra::SVector;
use std::collections::BTreeMap;

/// Place of a nodal value among the unknowns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Place {
    /// The unknown of this number: of several components if a plate ties them.
    Free(usize),
    /// This value (m, Pa).
    Held(f64),
    /// No particle sees it.
    Unseen,
}

/// The unknowns of a step, of all nodal values.
pub(super) struct Unknowns<const D: usize> {
    /// Places of every node of the displacement.
    pub(super) displacement: Vec<[Place; D]>,
    /// Place of every node of the pressure.
    pub(super) pressure: Vec<Place>,
    /// Unknown displacements.
    pub(super) displacements: usize,
    /// Unknown displacements and pressures.
    pub(super) count: usize,
}

/// The number of the next unknown.
fn next(count: &mut usize) -> usize {
    *count += 1;
    *count - 1
}

impl<const D: usize> Unknowns<D> {
    /// Unknowns of functions on `elements` of the displacement and the pressure, with their numbers of nodes and cell
    /// sizes (m). Two functions give held values; components that a plate ties are one unknown.
    pub(super) fn new(
        elements: [&Elements<D>; 2],
        nodes: [usize; 2],
        h: [f64; 2],
        held_displacement: impl Fn(usize, usize) -> Option<f64>,
        tied: impl Fn(usize, usize) -> Option<usize>,
        held_pressure: impl Fn(usize) -> Option<f64>,
    ) -> Self {
        let mut count = 0;
        let of = |k: usize| elements[k].seen_nodes(nodes[k], h[k]);
        // Unknown of every plate, numbered at the first of its nodes.
        let mut plates: BTreeMap<usize, usize> = BTreeMap::new();
        let displacement: Vec<[Place; D]> = (of(0).into_iter().enumerate())
            .map(|(n, seen)| {
                std::array::from_fn(|a| match (seen, held_displacement(n, a), tied(n, a)) {
                    (false, ..) => Place::Unseen,
                    (true, Some(value), _) => Place::Held(value),
                    (true, None, None) => Place::Free(next(&mut count)),
                    (true, None, Some(plate)) => {
                        let of_plate = plates.entry(plate);
                        Place::Free(*of_plate.or_insert_with(|| next(&mut count)))
                    }
                })
            })
            .collect();
        let displacements = count;
        let pressure: Vec<Place> = (of(1).into_iter().enumerate())
            .map(|(n, seen)| match (seen, held_pressure(n)) {
                (false, _) => Place::Unseen,
                (true, Some(value)) => Place::Held(value),
                (true, None) => Place::Free(next(&mut count)),
            })
            .collect();
        Self { displacements, displacement, pressure, count }
    }

    /// Whether a particle sees a node: of the displacement, the first space, or of the pressure.
    pub(super) fn sees(&self, space: usize, node: usize) -> bool {
        match space {
            0 => self.displacement[node][0] != Place::Unseen,
            _ => self.pressure[node] != Place::Unseen,
        }
    }

    /// The nodal values of displacement and pressure for the unknowns `x`.
    pub(super) fn spread(&self, x: &[f64]) -> (Vec<[f64; D]>, Vec<f64>) {
        let value = |place: Place| match place {
            Place::Free(i) => x[i],
            Place::Held(value) => value,
            Place::Unseen => 0.0,
        };
        let displacement = self.displacement.iter().map(|node| node.map(value));
        (displacement.collect(), self.pressure.iter().map(|p| value(*p)).collect())
    }

    /// The numbers of the unknowns of some nodes of the displacement, component by component, and of some of the
    /// pressure.
    pub(super) fn of(&self, displacement: &[usize], pressure: &[usize]) -> Vec<Option<usize>> {
        let number = |place: Place| match place {
            Place::Free(i) => Some(i),
            Place::Held(_) | Place::Unseen => None,
        };
        let components = displacement.iter().flat_map(|n| self.displacement[*n]);
        let pressures = pressure.iter().map(|n| self.pressure[*n]);
        components.chain(pressures).map(number).collect()
    }

    /// The unknowns' start: no displacement, and the pressures `of` nodes (Pa).
    pub(super) fn begin(&self, of: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; self.count];
        for (place, p) in self.pressure.iter().zip(of) {
            if let Place::Free(i) = place {
                x[*i] = *p;
            }
        }
        x
    }
}

/// The volume averages of the particles' pressures at the nodes (Pa); zero where there are none.
pub(super) fn mapped<const D: usize>(
    elements: &Elements<D>,
    nodes: usize,
    particles: &Particles<D>,
    pores: &Pores<D>,
) -> Vec<f64> {
    let weighted: Vec<f64> = (pores.pressure.iter().zip(&particles.volume)).map(|(p, v)| p * v).collect();
    let sums = elements.sums(nodes, &weighted);
    let volumes = elements.sums(nodes, &particles.volume);
    let mean = |(sum, volume): (&f64, &f64)| if *volume > 0.0 { sum / volume } else { 0.0 };
    sums.iter().zip(&volumes).map(mean).collect()
}

/// The volume averages at the nodes of what particles extrapolate to there by the pressures and slopes of the last step
/// (Pa), as they were at its start: exact of affine pressures. No number where there are none.
pub(super) fn extrapolated<const D: usize>(
    elements: &Elements<D>,
    functions: &dyn OfHats<D>,
    particles: &Particles<D>,
    pores: &Pores<D>,
) -> Vec<f64> {
    let grid = functions.grid();
    let mut places = vec![[0.0; D]; functions.len()];
    functions.for_each_node(&mut |node, place| places[node] = place);
    let mut sums = vec![SVector::<f64, 2>::zeros(); functions.len()];
    elements.scatter(SVector::zeros(), &mut sums, |p, sums| {
        let (nodes, w, _) = elements.seen(p);
        let x = &pores.place[p];
        for ((node, w), sum) in nodes.iter().zip(w).zip(sums) {
            let mut pressure = pores.pressure[p];
            for (a, axis) in grid.axes.iter().enumerate() {
                let mut apart = places[*node][a] - x[a];
                if axis.is_periodic() {
                    let period = axis.cells as f64 * grid.h;
                    apart -= period * (apart / period).round();
                }
                pressure += pores.slope[p][a] * apart;
            }
            let volume = w * particles.volume[p];
            *sum += SVector::from([volume * pressure, volume]);
        }
    });
    sums.iter().map(|sum| sum[0] / sum[1]).collect()
}

/// The pattern of a symmetric matrix in which the unknowns of each of the `groups` see one another.
pub(super) fn pattern(count: usize, groups: &[Vec<Option<usize>>]) -> Pattern {
    let mut beside: Vec<Vec<usize>> = (0..count).map(|i| vec![i]).collect();
    for group in groups {
        for column in group.iter().flatten() {
            beside[*column].extend(group.iter().flatten());
        }
    }
    let mut pattern = Pattern { width: 1, begin: vec![0], row: Vec::new() };
    for rows in &mut beside {
        rows.sort_unstable();
        rows.dedup();
        pattern.row.append(rows);
        pattern.begin.push(pattern.row.len());
    }
    pattern
}
