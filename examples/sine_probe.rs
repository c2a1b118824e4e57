use transpoint::scene::*; use transpoint::*;
fn main(){
 for (jit,label) in [(0.0,"reg"),(0.3,"jit")] {
 for v in Variant::ALL {
  let mut ep=vec![];
  for h in [0.02,0.01,0.008,0.005,0.004f64] {
   let nx=(1.0/h as f64).round() as usize; let ny=(0.1/h).round() as usize;
   let mut seed=12345u64; let mut rnd=||{ seed=seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407); ((seed>>11) as f64)/((1u64<<53) as f64)*2.0-1.0};
   let mut points=vec![];
   for i in 0..2*nx { for j in 0..2*ny {
     let x=(i as f64+0.5)*h/2.0+jit*h/2.0*rnd(); let y=(j as f64+0.5)*h/2.0+jit*h/2.0*rnd();
     let k=2.0*std::f64::consts::PI;
     points.push(PointSpec{position:[x,y],velocity_gradient:[[k*k*0.001/0.02*(k*x).cos(),0.0],[0.0,0.0]],velocity:[k*0.001/0.02*(k*x).sin(),0.0],density:1000.0,mass:1000.0*h*h/4.0});
   }}
   let scene=Scene::<2>{grid:GridSpec{origin:[0.0,0.0],spacing:[h,h],cells:[nx,ny]},boundaries:[[Boundary::Slip;2];2],equation_of_state:EquationOfStateSpec::WeaklyCompressible{reference_density:1000.0,sound_speed:50.0},body_force:[0.0,0.0],viscosity:None,points};
   let mut s=v.build_2d(&scene,&Settings::default()).unwrap();
   let t0=std::time::Instant::now();
   for _ in 0..std::env::args().nth(1).map_or(10,|a|a.parse().unwrap()) { if let Err(e)=s.step(5e-7){ println!("{e}"); break;} }
   let el=t0.elapsed().as_secs_f64()/(s.counters().n_steps as f64)/s.n_points() as f64*1e9;
   let o=s.observe(); let t=o.time; let k=2.0*std::f64::consts::PI; let w=k/0.02;
   let scale=0.1/(ny as f64*h);
   let e:f64=o.points.iter().map(|p|{let pe=-1000.0*2500.0*0.001*k*(k*p.position[0]).cos()*(w*t).sin(); (p.pressure-pe).powi(2)*p.volume()*scale}).sum::<f64>().sqrt();
   ep.push((e,el));
  }
  let ord=(ep[0].0/ep[4].0).ln()/(5f64).ln();
  println!("{label} {:10} {:?} order {ord:.2} ns {:.0}",v.name(),ep.iter().map(|e|format!("{:.4e}",e.0)).collect::<Vec<_>>(),ep[4].1);
 }}
}
