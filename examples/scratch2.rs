use spiral_atlas::num::Interval;
use spiral_atlas::family::*; use spiral_atlas::grid::*; use spiral_atlas::family::cubic::*;
fn time(n:&str,m:u32,mut f:impl FnMut()){let s=std::time::Instant::now();for _ in 0..m{f();}println!("{n} {:.2} us",s.elapsed().as_secs_f64()/m as f64*1e6);}
fn main(){
 for bits in [128,256]{ 
 time("sincos",50,||{std::hint::black_box(Interval::sin_cos(0.7,bits));});
 let (a,b)=Interval::sin_cos(0.7,bits);
 time("mul",1000,||{std::hint::black_box(&a*&b);}); time("add",1000,||{std::hint::black_box(&a+&b);}); time("div",1000,||{std::hint::black_box(a.over(&b));});
 }
 let g=Grid::new(vec![Axis::new("phi0",Spacing::Values(vec![0.7])).unwrap(),Axis::new("phi1",Spacing::Values(vec![1.4])).unwrap(),Axis::new("kappa0",Spacing::Values(vec![0.4])).unwrap(),Axis::new("kappa1",Spacing::Values(vec![4.])).unwrap()]).unwrap();
 let t=Cubic.table(&g).unwrap();
 time("exact",50,||{std::hint::black_box(t.exact(0).unwrap());});
}
