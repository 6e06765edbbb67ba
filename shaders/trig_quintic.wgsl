fn evaluate(index: vec4<u32>) -> u32 { return UNDECIDED; }
