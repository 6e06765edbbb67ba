// The frame of every evaluator: from an invocation to nodes, from codes to words.
// A family's fragments define `fn evaluate(index: vec4<u32>) -> u32`: the code of the node with these axis indices,
// flags in the low byte, counts in the next, 0xffff when undecided. They may read `inputs` and `params.offsets`.

struct Params {
    // Counts of the axes, slowest first; a grid of fewer than four axes has trailing ones.
    shape: vec4<u32>,
    // Axis indices of the chunk's first node.
    first: vec4<u32>,
    // The numbers 1 and 2 * GROUP_SIZE - 2 as digits in the mixed radix `shape`.
    one: vec4<u32>,
    hop: vec4<u32>,
    // The family's own: where each of its tables begins in `inputs`.
    offsets: vec4<u32>,
    // Number of nodes in the chunk, less than 2^26.
    count: u32,
    // The number 2. It comes from outside, so that compilers do not know it and cannot unroll a loop of two rounds.
    two: u32,
}

@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> inputs: array<f32>;
// Two codes a word, the earlier node low, complemented: a word that nothing wrote (zero) says undecided twice.
@group(0) @binding(2) var<storage, read_write> codes: array<u32>;

// Set from eval::gpu when the pipeline is made; no defaults, so that they cannot drift.
override GROUP_SIZE: u32;
override WORDS_PER_THREAD: u32;

// Axis indices `count` nodes after those of `index`. Counts are at most 2^24 and `count` is below 2^27: no overflow.
fn advance_by(index: vec4<u32>, count: u32) -> vec4<u32> {
    let w = index.w + count;
    let z = index.z + w / params.shape.w;
    let y = index.y + z / params.shape.z;
    let x = index.x + y / params.shape.y;
    return vec4<u32>(x, y % params.shape.y, z % params.shape.z, w % params.shape.w);
}

// The same for a number given as digits: carries, no divisions. The slowest index may run past its count at the
// end of the grid, where no node is left to evaluate.
fn advance(index: vec4<u32>, digits: vec4<u32>) -> vec4<u32> {
    var sum = index + digits;
    if sum.w >= params.shape.w {
        sum.w -= params.shape.w;
        sum.z += 1u;
    }
    if sum.z >= params.shape.z {
        sum.z -= params.shape.z;
        sum.y += 1u;
    }
    if sum.y >= params.shape.y {
        sum.y -= params.shape.y;
        sum.x += 1u;
    }
    return sum;
}

// Whether loops still run to their end. Mesa's llvmpipe leaves every loop of an invocation after one round once 65,535
// rounds have been run in all: what was evaluated before may be wrong then, and this loop stops short too.
fn loops_are_whole() -> bool {
    var rounds = 0u;
    for (var i = 0u; i < params.two; i += 1u) {
        rounds += 1u;
    }
    return rounds == params.two;
}

// Neighbouring invocations write neighbouring words, and a whole workgroup hops on together: stores are contiguous,
// and so are, mostly, branches and reads.
@compute @workgroup_size(GROUP_SIZE)
fn main(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let words = (params.count + 1u) / 2u;
    let group_index = group.y * groups.x + group.x;
    var word = group_index * (GROUP_SIZE * WORDS_PER_THREAD) + lane;
    var index = advance_by(params.first, 2u * word);
    for (var i = 0u; i < WORDS_PER_THREAD; i += 1u) {
        if word >= words {
            break;
        }
        var packed = 0u;
        // One call site: drivers inline `evaluate`, which is large.
        for (var half = 0u; half < 2u; half += 1u) {
            if 2u * word + half < params.count {
                let code = evaluate(index);
                packed |= select(0u, (~code & 0xffffu) << (16u * half), loops_are_whole());
            }
            index = advance(index, params.one);
        }
        codes[word] = packed;
        index = advance(index, params.hop);
        word += GROUP_SIZE;
    }
}
