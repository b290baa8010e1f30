//! Columns in blocks of eight.

use mpm_core::eights::*;
use mpm_core::number::EIGHT;
use nalgebra::SMatrix;

#[test]
fn a_column_is_read_and_written_in_blocks_as_far_as_it_goes() {
    for n in 1..20 {
        let column: Vec<f64> = (0..n).map(f64::from).collect();
        let n = column.len();
        let eights = Eights::of(&column);
        let mut copy = vec![-1.0; n];
        for k in 0..blocks(n) {
            eights.fetch(k + AHEAD);
            for l in 0..EIGHT {
                assert_eq!(eights.at(k)[l], column[(k * EIGHT + l).min(n - 1)]);
            }
            assert_eq!(entries(n, k), if k < n / EIGHT { EIGHT } else { n % EIGHT });
            assert_eq!(block(&column, k, &mut None), eights.at(k));
            store_numbers(&mut copy, k, numbers(&column, k));
        }
        assert_eq!(copy, column);
    }
    assert_eq!(blocks(0), 0);
}

#[test]
fn numbers_side_by_side_and_back_are_the_same() {
    let row = std::array::from_fn(|l| [l as f64, 0.5 + l as f64, -(l as f64)]);
    assert_eq!(components(&row)[1].as_array()[3], 3.5);
    let mut rows = row;
    store_vectors(&mut rows, 0, &components(&row).map(|x| x + x));
    assert_eq!(rows, row.map(|row| row.map(|x| x + x)));
    let square = std::array::from_fn(|l| SMatrix::<f64, 2, 2>::new(1.0, 2.0, l as f64, 4.0));
    assert_eq!(matrix_entries(&square)[1][0].as_array()[3], 3.0);
}
