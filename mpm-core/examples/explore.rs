//! x
#![allow(clippy::all)]
use mpm_core::basis::*; use mpm_core::*; use mpm_core::material::*; use mpm_core::remedy::*; use mpm_core::stage::*;
fn build<const S:usize,B:Basis<S>+'static>(h:f64, remedy:Box<dyn Remedy<2>>, damp:f64, cfl:f64)->Box<dyn Simulation<2>>{
  let law=NeoHookean::new(70.0,0.499).unwrap();
  let s=h/2.0; let mut pos=vec![];
  for i in 0..(48.0/s) as usize { let x=(i as f64+0.5)*s; for j in 0..(60.0/s) as usize { let y=(j as f64+0.5)*s;
    if y>=44.0*x/48.0-1e-9 && y<=44.0+16.0*x/48.0+1e-9 {pos.push([x,y]);}}}
  let p=Particles::new(pos,s*s,1.0,[s/2.0;2]).unwrap();
  let grid=Grid::new(h,[Axis::bounded(0.0,(52.0/h) as usize,(Side::Wall,Side::Open)),Axis::open(-4.0,(72.0/h) as usize)]).unwrap();
  let load=DeadForce::shared([0.0,1.0],std::env::var("R").map(|t|t.parse().unwrap()).unwrap_or(0.0),&p,|x|x[0]>48.0-s);
  let c=law.wave_speed(1.0);
  let n=p.len(); eprintln!("n={n} loaded {}",load.count());
  let mut ff:Vec<Box<dyn ForceFilter>>=vec![]; let mut pf:Vec<Box<dyn ParticleFilter<2>>>=vec![];
  if damp>0.0 {ff.push(Box::new(LocalDamping::new(damp.abs()).unwrap()))} if std::env::var("K").is_ok() {pf.push(Box::new(KineticDamping::default()))}
  Box::new(Solver::<2,S,B,NeoHookean>::new(Scene{grid,wall:WallTreatment::OpenKnot,law,particles:p,remedy,loads:vec![Box::new(load)],force_filters:ff,constraints:vec![Box::new(Wall{axis:0,end:End::Lo,kind:WallKind::Fixed})],particle_filters:pf,flip:std::env::var("E").map(|t|t.parse().unwrap()).unwrap_or(1.0),dt:solver::courant_time_step(cfl,h,c)}).unwrap())
}
fn main(){
  let a:Vec<String>=std::env::args().collect();
  let h:f64=a[2].parse().unwrap();
  let remedy:Box<dyn Remedy<2>>=match a[3].as_str(){"none"=>Box::new(Standard),"rec"=>Box::<FbarRecursive>::default(),"tot"=>Box::<FbarTotal>::default(),_=>Box::<FbarRate>::default()};
  let damp:f64=a[4].parse().unwrap(); let tend:f64=a[5].parse().unwrap(); let cfl:f64=a[6].parse().unwrap();
  let mut s=match a[1].as_str(){"gimp"=>build::<3,Gimp>(h,remedy,damp,cfl),"b2"=>build::<3,QuadraticBSpline>(h,remedy,damp,cfl),_=>build::<4,CubicBSpline>(h,remedy,damp,cfl)};
  let pool=rayon::ThreadPoolBuilder::new().num_threads(std::env::var("T").map(|t|t.parse().unwrap()).unwrap_or(1)).build().unwrap();
  let t0=std::time::Instant::now(); let mut next=0.0;
  pool.install(||{
  while s.time()<tend { if let Err(e)=s.step(){println!("{e}");break}
    if s.time()>=next { next+=tend/60.0; let t=s.totals(); let r=s.residual(); let p=s.particles();
      let (mut best,mut d)=(0,1e9); for k in 0..p.len(){let q=p.reference[k]; let e=(q[0]-48.0).powi(2)+(q[1]-60.0).powi(2); if e<d{d=e;best=k}}
      let e=t.kinetic_energy+t.stored_energy-t.accumulated.load_work; 
      println!("t {:.2} tip {:.6} KE {:.3e} U {:.5e} R {:.3e} reac {:.5} gap {:.3e} E {:.3e} sw {:.5e} fl {:.3e}",s.time(),p.position[best][1]-p.reference[best][1],t.kinetic_energy,t.stored_energy,r.free_force,r.held_force[1],t.log_jacobian_gap_rms,e,t.accumulated.stress_work,t.accumulated.filter_loss);}
  }});
  {let p=s.particles(); let mut v:Vec<(f64,usize)>=(0..p.len()).map(|k|(p.velocity[k][0].hypot(p.velocity[k][1]),k)).collect(); v.sort_by(|a,b|b.0.total_cmp(&a.0)); for (q,k) in v.iter().take(12){println!("v {q:.3e} at {:?} X {:?} vel {:?}",p.position[*k],p.reference[*k],p.velocity[*k]);} let (mut mx,mut my)=(0.0,0.0); for k in 0..p.len(){mx+=p.velocity[k][0];my+=p.velocity[k][1];} println!("mean v {} {}",mx/p.len() as f64,my/p.len() as f64);}
  let el=t0.elapsed().as_secs_f64(); let w=s.work(); println!("{:.2} s, {:.1} ns/particle-step, steps {} sorts {}",el,el*1e9/w.particle_steps as f64,w.steps,w.sorts);
}
