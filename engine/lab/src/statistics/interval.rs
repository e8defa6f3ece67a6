//! The interval of a median from order statistics.

use super::Interval;

/// Nonparametric confidence interval of the median of independent values.
///
/// Each value lies below the true median with probability 1/2, so the number of values below it is
/// binomial, and the k-th smallest and k-th largest value enclose it with probability
/// 1 − 2 P(B(n, 1/2) < k) (W. J. Conover, "Practical Nonparametric Statistics", 3rd edition 1999,
/// section 3.2). The largest such k is taken, and the level that it reaches is returned. `None` if
/// even the whole range does not reach the level: for 95 %, below six values.
pub fn median_interval(sorted: &[f64], level: f64) -> Option<Interval> {
    let n = sorted.len();
    let tail = (1.0 - level) / 2.0;
    // ln P(B = i), by the quotient of neighbouring terms; powers of 1/2 would underflow.
    let mut log_term = -(n as f64) * std::f64::consts::LN_2;
    let mut below = 0.0;
    let mut found = None;
    for k in 1..=n / 2 {
        // `below` becomes P(B < k) = P(B ≤ k − 1).
        below += log_term.exp();
        if below > tail {
            break;
        }
        found = Some((k, 1.0 - 2.0 * below));
        let i = (k - 1) as f64;
        log_term += ((n as f64 - i) / (i + 1.0)).ln();
    }
    let (k, level) = found?;
    Some(Interval {
        low: sorted[k - 1],
        high: sorted[n - k],
        level,
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn ranks(n: usize, level: f64) -> Option<(usize, usize, f64)> {
        let values: Vec<f64> = (1..=n).map(|i| i as f64).collect();
        median_interval(&values, level).map(|i| (i.low as usize, i.high as usize, i.level))
    }

    #[test]
    fn ranks_agree_with_printed_tables() {
        // Ranks and exact levels of the 95 % interval of a median, from binomial tables:
        // n = 6: 1 − 2/64; n = 10: 1 − 2·(1 + 10)/1024; n = 20: 1 − 2·21700/2²⁰.
        for (n, low, high, level) in [
            (6, 1, 6, 1.0 - 2.0 / 64.0),
            (10, 2, 9, 1.0 - 22.0 / 1024.0),
            (20, 6, 15, 1.0 - 2.0 * 21_700.0 / 1_048_576.0),
        ] {
            let (l, h, reached) = ranks(n, 0.95).unwrap();
            assert_eq!((l, h), (low, high), "n = {n}");
            assert!((reached - level).abs() < 1e-12, "n = {n}: {reached}");
        }
        // n = 100: ranks 40 and 61, as printed by Conover.
        assert_eq!(ranks(100, 0.95).map(|r| (r.0, r.1)), Some((40, 61)));
    }

    #[test]
    fn too_few_values_give_no_interval() {
        for n in 0..6 {
            assert_eq!(ranks(n, 0.95), None);
        }
        assert!(ranks(6, 0.99).is_none() && ranks(8, 0.99).is_some());
    }

    #[test]
    fn large_counts_do_not_underflow() {
        // Normal approximation: n/2 − 1.96 √n/2 = 50000 − 309.9.
        let (low, high, level) = ranks(100_000, 0.95).unwrap();
        assert!((49_688..=49_692).contains(&low), "{low}");
        assert_eq!(low + high, 100_001);
        assert!((0.95..0.951).contains(&level));
    }
}
