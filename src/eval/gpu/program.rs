//! A family's shader, compiled for one device.

use super::adapter::Gpu;
use super::{GROUP_SIZE, Settings, assemble, validate};
use crate::error::Result;
use crate::family::Shader;

/// The pipeline and what fits it.
pub(super) struct Program {
    pub pipeline: wgpu::ComputePipeline,
    pub layout: wgpu::BindGroupLayout,
    pub settings: Settings,
}

impl Program {
    /// Assembles, validates and compiles a shader.
    pub(super) fn new(gpu: &Gpu, shader: &Shader, settings: Settings) -> Result<Program> {
        let assembled = assemble(shader);
        // First, so that errors are reported in the fragments' own lines.
        validate(&assembled)?;
        let device = &gpu.device;
        let layout = layout(device);
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("family"),
            source: wgpu::ShaderSource::Wgsl(assembled.source.into()),
        });
        let constants =
            [("GROUP_SIZE", f64::from(GROUP_SIZE)), ("WORDS_PER_THREAD", f64::from(settings.words_per_thread))];
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("family"),
            layout: Some(&device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("family"),
                bind_group_layouts: &[Some(&layout)],
                immediate_size: 0,
            })),
            module: &module,
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() },
            cache: None,
        });
        gpu.check()?;
        Ok(Program { pipeline, layout, settings })
    }
}

/// The bindings of `lib/main.wgsl`. Said here rather than taken from the shader, whose unused bindings would be
/// missing.
fn layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let kinds = [
        wgpu::BufferBindingType::Uniform,
        wgpu::BufferBindingType::Storage { read_only: true },
        wgpu::BufferBindingType::Storage { read_only: false },
    ];
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("chunk"),
        entries: &std::array::from_fn::<_, 3, _>(|i| wgpu::BindGroupLayoutEntry {
            binding: i as u32,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer { ty: kinds[i], has_dynamic_offset: false, min_binding_size: None },
            count: None,
        }),
    })
}
