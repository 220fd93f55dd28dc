// The same for tables in the rows of a texture (width: nodes, height: functions), sampled linearly: a texel's centre is
// half a texel from its edge.
float lookup(sampler2D functions, int k, float cos_theta) {
  vec2 size = vec2(textureSize(functions, 0));
  return texture(functions, vec2((sqrt(cos_theta) * (size.x - 1.0) + 0.5) / size.x, (float(k) + 0.5) / size.y)).r;
}

// What f(L,V) is multiplied with after so many pumpings, control none; `total` is
// min(factor, 1.0 / max(cos_l, cos_v)) after each step, `step` the same of g.
float pumping(sampler2D functions, int times, float cos_l, float cos_v) {
  float factor = 1.0;
  for (int k = 0; k < times; ++k) {
    float g = min(lookup(functions, k, cos_l), lookup(functions, k, cos_v));
    factor *= g;
  }
  return factor;
}

// What f(L,V) is multiplied with (1/s), and what is added to it (m).
float balance(sampler2D functions, float cos_l, float cos_v) {
  return lookup(functions, 0, cos_l) * lookup(functions, 0, cos_v);
}
float multiscatter(sampler2D functions, float cos_l, float cos_v) {
  return lookup(functions, 0, cos_l) * lookup(functions, 0, cos_v);
}

// What f(L,V) is multiplied with (1/a).
float turquin(sampler2D functions, float cos_l, float rho) {
  return 1.0 - rho + rho * lookup(functions, 0, cos_l);
}
