#include "app/render/shaders.hpp"

namespace clay::render {
namespace {

constexpr const char* kFrame = R"(
layout(std140) uniform Frame {
  mat4 view_projection;
  vec4 eye, to_lamp, to_rim_lamp;
  vec4 lamp, sky, bounce, rim;
  vec4 low, high;
  vec4 viewport, wall_map, wheel;
  vec4 lamp_across, lamp_upward, strip_across, strip_upward;
} frame;
)";

constexpr const char* kColour = R"(
// Place in the whole picture, of which the framebuffer may be a strip.
vec2 pixel() { return gl_FragCoord.xy + vec2(0.0, frame.viewport.w); }

// sRGB by three square roots instead of a power (least squares; error below 0.3/255 above 0.0031),
// plus half a step of noise, so that smooth gradients show no bands.
vec4 shown(vec3 linear) {
  vec3 c = clamp(linear, 0.0, 1.0);
  vec3 s1 = sqrt(c), s2 = sqrt(s1), s3 = sqrt(s2);
  vec3 srgb = 0.662002687 * s1 + 0.684122060 * s2 - 0.323583601 * s3 - 0.0225411470 * c;
  srgb = mix(12.92 * c, srgb, step(0.0031308, c));
  float noise = fract(52.9829189 * fract(dot(pixel(), vec2(0.06711056, 0.00583715))));
  return vec4(srgb + (noise - 0.5) / 255.0, 1.0);
}

vec3 background() {
  vec2 uv = pixel() / frame.viewport.xy;
  vec2 off = (uv - vec2(0.5, 0.46)) * vec2(1.0, 0.9);
  return mix(frame.high.rgb, frame.low.rgb, smoothstep(0.0, 0.75, length(off)));
}
)";

constexpr const char* kLight = R"(
// The lamp is a window: at the edge of the shade a part of it is still seen. `facing`: the cosine
// to its middle.
float lamp_light(float facing) {
  const float kHalf = 0.30;  // of the zone in which the window sets
  float in_zone = clamp(facing + kHalf, 0.0, 2.0 * kHalf);
  return facing > kHalf ? facing : in_zone * in_zone / (4.0 * kHalf);
}

// Matte with a sheen that grows at grazing angles, like a wet surface. `open`: visible fraction of
// the sky; `lit`: visible fraction of the lamp.
vec3 lit_surface(vec3 base, vec3 n, vec3 v, float open, float lit, float gloss, float shine) {
  vec3 l = frame.to_lamp.xyz, h = normalize(l + v);
  float facing = lamp_light(dot(n, l));
  vec3 ambient = mix(frame.bounce.rgb, frame.sky.rgb, 0.5 + 0.5 * n.y);
  // Parts hidden from the sky receive a little light reflected by clay.
  vec3 diffuse = base * (ambient * mix(0.16 * base + 0.10, vec3(1.0), open) +
                         frame.lamp.rgb * facing * lit);
  float grazing = 1.0 - clamp(dot(n, v), 0.0, 1.0);
  grazing *= grazing;
  grazing *= grazing;
  float edge = clamp(dot(n, frame.to_rim_lamp.xyz), 0.0, 1.0) * open;
  vec3 sheen = frame.lamp.rgb * (shine * pow(clamp(dot(n, h), 0.0, 1.0), gloss) * lit * facing) +
               frame.rim.rgb * edge * (0.10 + 0.9 * grazing) * (0.5 + 0.5 * base);
  return diffuse + sheen + frame.sky.rgb * grazing * 0.10 * open;
}

// A lamp as wide as its box: how much of the blurred reflection `r` it fills. `axis`: to its middle.
float softbox(vec3 r, vec3 axis, vec3 across, vec3 upward, vec2 half_size, float blur) {
  float ahead = max(dot(r, axis), 0.02);
  vec2 off = abs(vec2(dot(r, across), dot(r, upward))) / ahead;
  vec2 soft = vec2(0.02 + 1.4 * blur);
  vec2 filled = 1.0 - smoothstep(half_size - soft, half_size + soft, off);
  vec2 spread = half_size / (half_size + 0.5 * soft);
  return filled.x * filled.y * spread.x * spread.y * step(0.03, ahead);
}

// The room that shiny surfaces reflect: a window at the lamp, a strip of light at the rim lamp, a
// pale ceiling and a dark floor.
vec3 studio(vec3 r, float blur) {
  vec3 room = mix(0.3 * frame.bounce.rgb + 0.1 * frame.low.rgb, 0.75 * frame.sky.rgb,
                  smoothstep(-0.35 - blur, 0.65 + blur, r.y));
  float window = softbox(r, frame.to_lamp.xyz, frame.lamp_across.xyz, frame.lamp_upward.xyz,
                         vec2(0.34, 0.42), blur);
  float strip = softbox(r, frame.to_rim_lamp.xyz, frame.strip_across.xyz, frame.strip_upward.xyz,
                        vec2(0.16, 0.75), blur);
  return room + 7.0 * window * frame.lamp.rgb + 6.0 * strip * frame.rim.rgb;
}

// A clear layer over a surface: `coat` is its strength and its roughness.
vec3 coated(vec3 under, vec3 n, vec3 v, float open, vec2 coat) {
  // Smoothed normals at an outline face away; they would mirror the floor.
  float away = 1.0 - clamp(dot(n, v), 0.15, 1.0), squared = away * away;
  float mirrored = coat.x * (0.04 + 0.96 * squared * squared * away);
  vec3 seen = studio(reflect(-v, n), coat.y) * mix(0.08, 1.0, open * open);
  return mix(under, seen, mirrored);
}

// Compresses bright values instead of clipping them.
vec3 exposed(vec3 c) { return c * (1.0 + c * 0.12) / (1.0 + c * 0.42); }
)";

constexpr const char* kWallColour = R"(
uniform vec4 map_colours[17];
uniform vec3 thin_wall, thin_wall_stripe;

// `slope`: of the stripes on walls that are too thin, 1 or -1.
vec3 wall_colour(float wall, float slope) {
  float at = clamp(wall / frame.wall_map.y, 0.0, 1.0) * 16.0;
  int below = min(int(at), 15);
  vec3 colour = mix(map_colours[below].rgb, map_colours[below + 1].rgb, at - float(below));
  if (wall >= frame.wall_map.x) return colour;
  vec2 at_stripe = pixel() / max(10.0, frame.viewport.y / 72.0);
  float stripe = fract(at_stripe.x + slope * at_stripe.y);
  return mix(thin_wall, thin_wall_stripe,
             smoothstep(0.62, 0.72, stripe) * (1.0 - smoothstep(0.88, 0.98, stripe)));
}
)";

constexpr const char* kRevolveVertex = R"(
layout(location = 0) in vec2 step_;     // fraction of the sweep, end of the stretch
layout(location = 1) in vec4 points_;   // (rho, y) start, end
layout(location = 2) in vec4 normals_;
layout(location = 3) in vec4 shade_;    // open start, end; wall start, end
layout(location = 4) in vec2 neck_;
uniform mat4 place;
uniform vec2 sweep;  // azimuth start, end
out vec3 world, normal, own;
centroid out vec3 shade;  // open; wall [mm]; azimuth
flat out vec2 neck;
void main() {
  float azimuth = mix(sweep.x, sweep.y, step_.x);
  vec2 around = vec2(sin(azimuth), cos(azimuth));
  vec2 p = mix(points_.xy, points_.zw, step_.y), n = mix(normals_.xy, normals_.zw, step_.y);
  own = vec3(p.x * around.x, p.y, p.x * around.y);
  vec4 at = place * vec4(own, 1.0);
  world = at.xyz;
  normal = mat3(place) * vec3(n.x * around.x, n.y, n.x * around.y);
  shade = vec3(mix(shade_.xz, shade_.yw, step_.y), azimuth);
  neck = neck_;
  gl_Position = frame.view_projection * at;
}
)";

constexpr const char* kClayFragment = R"(
in vec3 world, normal, own;
centroid in vec3 shade;
flat in vec2 neck;
uniform mat4 place;
uniform vec2 rim;    // radius and height of the opening
uniform float turn;  // rotation of the clay with the wheel
uniform float cut;   // 1: light enters through the cut
uniform float hands; // 1: with traces of fingers
uniform vec4 base;   // colour; darkness of the specks
uniform vec2 lobe;   // exponent and strength of the body's own shine
#ifdef COATED
uniform vec2 coat;   // strength, roughness
uniform vec4 thin;   // colour where a glaze runs thin; 1: is a glaze
uniform vec3 bare;   // of the clay below a glaze
#endif
out vec4 colour;

// Slope of the wall due to spiral grooves from the fingers and to slower waves.
float grooves(float y, float azimuth, float size, float pixel) {
  float fine = 6.2832 / (0.0115 * size), coarse = fine * 0.31;
  float seen = 1.0 - smoothstep(0.15, 0.5, pixel * fine / 6.2832);
  return 0.050 * seen * sin(y * fine + azimuth) +
         0.035 * sin(y * coarse + azimuth + 1.3 * sin(y * coarse * 0.37));
}

// Specks of iron: at most one in each cell of a grid that turns with the clay.
float speck(vec3 at, float size, float pixel) {
  vec3 cell = floor(at / size), inside = at / size - cell - 0.5;
  vec3 noise = fract(sin(vec3(dot(cell, vec3(12.99, 78.23, 37.72)),
                              dot(cell, vec3(39.35, 11.14, 83.16)),
                              dot(cell, vec3(73.16, 52.24, 9.15)))) * 4375.85);
  float radius = 0.06 + 0.16 * noise.x * noise.x, edge = pixel / size + 0.02;
  float off = length(inside - 0.5 * (noise - 0.5));
  return step(0.72, noise.y) * (1.0 - smoothstep(radius - edge, radius + edge, off)) *
         (1.0 - smoothstep(0.15, 0.5, pixel / size));
}

float passes(vec2 ring, vec3 l) {
  float rise = ring.y - own.y;
  if (ring.x <= 0.0 || rise <= 0.0) return 1.0;
  vec3 at = own + l * (rise / max(l.y, 1e-3));
  float width = 0.06 * ring.x + 0.10 * rise;
  return smoothstep(-width, width, ring.x - length(at.xz));
}

void main() {
  vec3 n = normalize(normal), v = normalize(frame.eye.xyz - world);
  vec3 axis = place[1].xyz;
  vec3 l = transpose(mat3(place)) * frame.to_lamp.xyz;
  float azimuth = shade.z - turn;
  float upright = length(n - axis * dot(n, axis));  // grooves run along walls, not along rims
  float size = frame.wheel.w;
  float groove = grooves(own.y, azimuth, size, fwidth(own.y)) * upright * hands;
  // Where the light grazes the wall, a groove would be black beside a lit one.
  float grazed = smoothstep(0.0, 0.35, abs(dot(n, frame.to_lamp.xyz)));
  n = normalize(n + axis * groove * grazed);
  float lit = neck.x > 0.0 ? min(passes(neck, l), passes(rim, l)) : 1.0;
  lit = mix(lit, 1.0, 0.6 * cut * step(1e-6, neck.x));
  float open = mix(shade.x, 1.0, 0.35 * cut * step(1e-6, neck.x));
  if (frame.wall_map.z > 0.5) {
    vec3 base = wall_colour(shade.y, 1.0);
    float facing = 0.5 + 0.5 * dot(n, frame.to_lamp.xyz);
    colour = shown(base * mix(0.50, 1.0, facing * mix(0.5, 1.0, open)));
    return;
  }
  // Bands of the clay, and specks.
  float band = sin(own.y * 5.1 / (0.02 * size) + 2.0 * sin(azimuth)) *
               sin(own.y * 1.7 / (0.02 * size));
  float rho = length(own.xz);
  vec3 turned = vec3(rho * sin(azimuth), own.y, rho * cos(azimuth));
  float specks = base.a * hands * speck(turned, 0.016 * size, length(fwidth(own)));
#ifdef COATED
  // A glaze runs thin over the lip, and on the ridges that fingers leave. It ends above the foot.
  float lip = 1.0 - smoothstep(0.0, 0.030 * size, abs(own.y - rim.y));
  float ridge = hands * upright * (0.5 + 8.0 * groove);
  vec3 body = mix(base.rgb, thin.rgb, thin.a * clamp(0.9 * lip * lip + 0.16 * ridge, 0.0, 1.0));
  float foot = thin.a * hands * (1.0 - smoothstep(0.028 * size, 0.033 * size, own.y)) *
               step(neck.x, 0.0);
  body = mix(body, bare, foot) * (1.0 + 0.045 * band * hands * (1.0 - thin.a) + 0.4 * groove);
  vec2 layer = coat * vec2(1.0 - foot, 1.0);
#else
  vec3 body = base.rgb * (1.0 + 0.045 * band * hands + 0.9 * groove);
#endif
  body *= 1.0 - specks;
  vec3 c = lit_surface(body, n, v, open, lit, lobe.x, lobe.y);
#ifdef COATED
  c = coated(c, n, v, open, layer);
#endif
  colour = shown(exposed(c));
}
)";

constexpr const char* kPlainFragment = R"(
in vec3 world, normal, own;
centroid in vec3 shade;
flat in vec2 neck;
uniform vec4 base;         // colour; gloss
uniform vec4 touch;        // unit direction to the clay; 1 while touching
out vec4 colour;
void main() {
  vec3 n = normalize(normal), v = normalize(frame.eye.xyz - world);
  vec3 c = lit_surface(base.rgb, n, v, 1.0, 1.0, base.a, 0.35);
  float side = touch.w * smoothstep(0.40, 0.80, dot(n, touch.xyz));
  colour = shown(mix(exposed(c), vec3(1.0, 0.42, 0.05), side));
}
)";

constexpr const char* kShadowMap = R"(
uniform sampler2D shadow_map;
vec2 shadow_at(vec2 at) {
  vec2 uv = 0.5 + 0.5 * at / frame.viewport.z;
  vec2 inside = smoothstep(vec2(0.0), vec2(0.08), uv) * smoothstep(vec2(0.0), vec2(0.08), 1.0 - uv);
  return mix(vec2(1.0), texture(shadow_map, uv).rg, inside.x * inside.y);
}
)";

constexpr const char* kWheelFragment = R"(
in vec3 world, normal, own;
centroid in vec3 shade;
flat in vec2 neck;
uniform vec3 metal;
out vec4 colour;
void main() {
  vec3 n = normalize(normal), v = normalize(frame.eye.xyz - world);
  float radius = frame.wheel.y, rho = length(own.xz), width = fwidth(rho);
  float top = step(0.99, normal.y);
  vec2 light = mix(vec2(1.0), shadow_at(world.xz), top);
  // Turned grooves, a tenth of the radius apart; those finer than a pixel fade out.
  float pitch = 0.1 * radius;
  float groove = abs(fract(rho / pitch) - 0.5) * pitch;
  float line = (1.0 - smoothstep(0.0, 0.0035 * radius + width, groove)) *
               (1.0 - smoothstep(0.05, 0.4, width / pitch));
  // The mark that makes the rotation visible: a short line near the edge.
  float s = frame.to_rim_lamp.w, c = frame.to_lamp.w;
  vec2 turned = vec2(own.x * c - own.z * s, own.x * s + own.z * c);
  vec2 soft = vec2(-1.0, 1.0) * max(width, 1e-6);
  float bar = (1.0 - smoothstep(soft.x, soft.y, abs(turned.x) - 0.008 * radius)) *
              smoothstep(soft.x, soft.y, turned.y - 0.80 * radius) *
              (1.0 - smoothstep(soft.x, soft.y, turned.y - 0.95 * radius));
  vec3 base = metal * (1.0 - 0.22 * line * top);
  base = mix(base, metal * 0.18, bar * top);
  vec3 lit = lit_surface(base, n, v, light.y, light.x, 60.0, 0.10);
  colour = shown(exposed(lit));
}
)";

// The floor is the background, darkened where the wheel blocks the light.
constexpr const char* kGroundFragment = R"(
in vec3 world, normal, own;
centroid in vec3 shade;
flat in vec2 neck;
out vec4 colour;
void main() {
  float radius = frame.wheel.y, down = frame.wheel.z;
  vec2 moved = world.xz + frame.to_lamp.xz / frame.to_lamp.y * down;
  float lamp = smoothstep(-0.10, 0.10, length(moved) / radius - 1.0) * shadow_at(moved).x;
  float contact = exp(-max(length(world.xz) - radius, 0.0) / (0.16 * radius));
  float fade = 1.0 - smoothstep(1.6, 2.8, length(world.xz) / radius);
  float kept = (1.0 - 0.30 * (1.0 - lamp)) * (1.0 - 0.42 * contact);
  colour = shown(background() * mix(1.0, kept, fade));
}
)";

constexpr const char* kSliceVertex = R"(
layout(location = 0) in vec2 corner;  // x: bore, outside; y: low, high
layout(location = 1) in vec4 radii;   // low: bore, outside; high: bore, outside
layout(location = 2) in vec4 rest;    // y low, high; wall low, high
uniform mat4 place;
uniform float azimuth;
centroid out float wall;
void main() {
  vec2 ends = mix(radii.xy, radii.zw, corner.y);
  float rho = mix(ends.x, ends.y, corner.x), y = mix(rest.x, rest.y, corner.y);
  wall = mix(rest.z, rest.w, corner.y);
  gl_Position =
      frame.view_projection * place * vec4(rho * sin(azimuth), y, rho * cos(azimuth), 1.0);
}
)";

constexpr const char* kSliceFragment = R"(
centroid in float wall;
uniform vec4 section;  // colour
out vec4 colour;
void main() {
  // Stripes against those of the bore behind it set off the cut.
  colour = shown(frame.wall_map.z > 0.5 ? wall_colour(wall, -1.0) : section.rgb);
}
)";

template <class... Parts>
std::string joined(Parts... parts) {
  std::string text = kFrame;
  (text.append(parts), ...);
  return text;
}

}  // namespace

std::string background_vertex() {
  return joined(R"(
void main() {
  vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
  gl_Position = vec4(2.0 * corner - 1.0, 1.0, 1.0);
}
)");
}
std::string background_fragment() {
  return joined(kColour, "out vec4 colour;\nvoid main() { colour = shown(background()); }\n");
}
std::string revolve_vertex() { return joined(kRevolveVertex); }
std::string clay_fragment() { return joined(kColour, kLight, kWallColour, kClayFragment); }
std::string coated_clay_fragment() { return "#define COATED\n" + clay_fragment(); }
std::string plain_fragment() { return joined(kColour, kLight, kPlainFragment); }
std::string wheel_fragment() { return joined(kColour, kLight, kShadowMap, kWheelFragment); }
std::string ground_fragment() { return joined(kColour, kShadowMap, kGroundFragment); }
std::string slice_vertex() { return joined(kSliceVertex); }
std::string slice_fragment() { return joined(kColour, kWallColour, kSliceFragment); }

}  // namespace clay::render
