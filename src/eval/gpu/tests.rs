//! What cannot be done to an engine from outside: a device that is lost, a dispatch that does not do its work.

use super::*;
use crate::family::Shader;
use crate::grid::{Axis, Spacing};

struct Plain;

impl Kernel for Plain {
    fn shader(&self) -> Shader {
        let evaluate = "fn evaluate(index: vec4<u32>) -> u32 { return index.x & 0xfffu; }";
        Shader { constants: String::new(), fragments: vec![("plain.wgsl", evaluate)] }
    }
    fn inputs(&self, _: u64, _: u64) -> ShaderInputs {
        ShaderInputs { words: Vec::new(), offsets: [0; 4] }
    }
}

fn grid(count: usize) -> Grid {
    Grid::new(vec![Axis::new("u", Spacing::Linear { lo: 0.0, hi: 1.0, count }).unwrap()]).unwrap()
}

fn label() -> String {
    let usable = adapters().into_iter().find(|a| a.unusable.is_none());
    usable.expect("a GPU adapter; apt-get install -y --no-install-recommends libvulkan1 mesa-vulkan-drivers").label()
}

static GO: AtomicBool = AtomicBool::new(false);

#[test]
fn a_lost_device_is_an_error_and_stays_one() {
    let grid = grid(100_000);
    let settings = Settings { chunk_nodes: 1000, ..Settings::default() };
    let mut engine = Engine::new(Some(&label()), &Plain, &grid, &settings).unwrap();
    let device = engine.gpu.device.clone();
    let mut chunks = 0;
    let result = engine.run(0..grid.len(), &GO, |_, _| {
        chunks += 1;
        if chunks == 3 {
            device.destroy();
        }
        Ok(())
    });
    assert!(matches!(&result, Err(Error::Gpu(_))) && (3..=6).contains(&chunks), "{result:?} after {chunks}");
    let again = engine.run(0..10, &GO, |_, _| Ok(()));
    assert!(matches!(&again, Err(Error::Gpu(_))), "{again:?}");
}

#[test]
fn nodes_that_the_device_leaves_out_are_undecided() {
    let grid = grid(10_000);
    let settings = Settings { words_per_thread: 1, ..Settings::default() };
    let mut engine = Engine::new(Some(&label()), &Plain, &grid, &settings).unwrap();
    let run = |engine: &mut Engine| {
        let mut codes = Vec::new();
        engine
            .run(0..grid.len(), &GO, |_, chunk| {
                codes.extend_from_slice(chunk);
                Ok(())
            })
            .unwrap();
        codes
    };
    let right = run(&mut engine);
    assert!(right.iter().enumerate().all(|(i, code)| code.0 == i as u16 & 0xfff));
    // The pipeline was made for one word a thread: now it gets too few threads.
    engine.program.settings.words_per_thread = 4;
    let codes = run(&mut engine);
    let left_out = codes.iter().filter(|code| **code == Code::UNDECIDED).count();
    assert!((5000..10_000).contains(&left_out), "{left_out}");
    assert!(codes.iter().zip(&right).all(|(code, right)| code == right || *code == Code::UNDECIDED));
}
