use spiral_atlas::family::cubic::*;
use spiral_atlas::family::*;
use spiral_atlas::grid::*;
fn main() {
    let text = std::fs::read_to_string("/work/shared/vectors/cubic_points.json").unwrap();
    let v: serde_json::Value = serde_json::from_str(&text).unwrap();
    let (mut n, mut bad) = (0, 0);
    for q in v.as_array().unwrap() {
        let f = |k: &str| q[k].as_f64().unwrap();
        let b = |k: &str| q[k].as_bool().unwrap();
        let d = Datum { phi0: f("phi0"), phi1: f("phi1"), kappa0: f("kappa0"), kappa1: f("kappa1") };
        let s = match solve(&d) {
            Ok(s) => s,
            Err(e) => {
                println!("{e}");
                bad += 1;
                continue;
            }
        };
        let want = (b("solvable_paper") as u8)
            | (b("thm31_paper") as u8) << 1
            | (b("thm31_any") as u8) << 2
            | (b("spiral_any") as u8) << 3
            | (b("kneser") as u8) << 4;
        let roots = q["roots"].as_array().unwrap();
        let mut ok = want == s.flags() && roots.len() == s.roots().len();
        if ok {
            for (i, r) in s.roots().iter().enumerate() {
                let x = roots[i][0].as_f64().unwrap();
                let y = roots[i][1].as_f64().unwrap();
                if (x - r.f0).abs() > 1e-12 || (y - r.f1).abs() > 1e-12 {
                    println!("acc {:e} {:e}", x - r.f0, y - r.f1);
                }
                ok &= q["thm31"][i].as_bool().unwrap() == r.theorem31 && q["spiral"][i].as_bool().unwrap() == r.spiral;
                ok &= r.spiral == (r.margin > 0.0 && true) || d.kappa0 >= d.kappa1;
            }
        }
        n += 1;
        if !ok {
            bad += 1;
            println!("BAD {q} got {:05b} {:?}", s.flags(), s.roots());
        }
    }
    println!("{n} points {bad} bad");
    let ax = |n: &str, s| Axis::new(n, s).unwrap();
    let lin = |lo, hi, count| Spacing::Linear { lo, hi, count };
    let log = |lo, hi, count| Spacing::Log { lo, hi, count };
    let g = Grid::new(vec![
        ax("phi0", lin(0.05, 1.0, 41)),
        ax("phi1", lin(0.1, 1.55, 40)),
        ax("kappa0", lin(0.02, 0.8, 37)),
        ax("kappa1", log(0.5, 50.0, 512)),
    ])
    .unwrap();
    let c = Cubic;
    let t = c.table(&g).unwrap();
    let mut codes = vec![Code(0); g.len() as usize];
    for _ in 0..3 {
        let s = std::time::Instant::now();
        t.filter(0, &mut codes);
        let e = s.elapsed().as_secs_f64();
        println!("{} nodes {:.1} Mnodes/s", g.len(), g.len() as f64 / e / 1e6);
    }
    let und: Vec<usize> = (0..codes.len()).filter(|i| codes[*i] == Code::UNDECIDED).collect();
    println!("undecided {} of {}", und.len(), codes.len());
    let flag = |b: u8| codes.iter().filter(|c| **c != Code::UNDECIDED && c.flags() & b != 0).count();
    println!("solv {} thm {} any31 {} spiral {} any {}", flag(1), flag(2), flag(4), flag(8), flag(16));
    for i in und.iter().take(10) {
        println!("{} {:?}", g.describe(*i as u64), t.exact(*i as u64));
    }
    // compare with exact
    let mut z = 12345u64;
    let s = std::time::Instant::now();
    let mut wrong = 0;
    let m = 3000;
    let mut spir = 0;
    for _ in 0..m {
        z = z.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        let i = (z >> 33) % g.len();
        let (e, _) = t.exact(i).unwrap();
        let f = codes[i as usize];
        if f.flags() & 8 != 0 {
            spir += 1;
        }
        if f != Code::UNDECIDED && e != f {
            wrong += 1;
            println!("WRONG {} {:?} {:?}", g.describe(i), e, f);
        }
    }
    println!("{wrong} wrong of {m} ({spir} spirals), {:.0} us per exact", s.elapsed().as_secs_f64() / m as f64 * 1e6);
    let d = Datum { phi0: 0.7, phi1: 1.4, kappa0: 0.4, kappa1: 4.0 };
    println!("{:?}", solve(&d));
    let s = std::time::Instant::now();
    let mut acc = 0.0;
    for i in 0..200000 {
        let d = Datum { kappa1: 4.0 + i as f64 * 1e-6, ..d };
        acc += solve(&d).unwrap().roots()[0].f0;
    }
    println!("solve {:.0} ns {acc}", s.elapsed().as_secs_f64() / 200000.0 * 1e9);
    let mut out = [0f32; 3];
    let s = std::time::Instant::now();
    let mut cnt = 0;
    for i in (0..g.len()).step_by(97) {
        let c = codes[i as usize];
        if c != Code::UNDECIDED && c.flags() & 8 != 0 {
            t.scalars(i, c, &[0, 1, 2], &mut out).unwrap();
            cnt += 1;
        }
    }
    println!("scalars {:.0} ns x{cnt}", s.elapsed().as_secs_f64() / cnt as f64 * 1e9);
}
