/* The ground as triangles, from its samples: blocks of 32 x 32 cells, one an instance. To where
 * terrain.frag's rays would meet them, but for what two triangles are not of a patch. */
uniform vec3  u_forward, u_right, u_down, u_place, u_scale;
uniform bool  u_orthographic;
uniform vec4  u_window; /* of the picture, what is drawn now: scale, then shift */
uniform ivec2 hc_size;
uniform vec2  hc_steps, hc_zero;
uniform sampler2D hc_heights;

layout(location = 0) in vec3 a_block; /* its first sample; how far its hem hangs down, in heights */

out vec3 v_from_eye, v_place;

#define SIDE 32
#define ALONG 33
#define INNER 1089

/* Behind those of the block itself come those of its hem: top, right, bottom, left. */
ivec2 in_block(int vertex)
{
    int along = (vertex - INNER) % ALONG;
    if (vertex < INNER) {
        return ivec2(vertex % ALONG, vertex / ALONG);
    }
    switch ((vertex - INNER) / ALONG) {
    case 0: return ivec2(along, 0);
    case 1: return ivec2(SIDE, along);
    case 2: return ivec2(along, SIDE);
    default: return ivec2(0, along);
    }
}

void main(void)
{
    ivec2 sample_ = min(ivec2(a_block.xy) + in_block(gl_VertexID), hc_size - 1);
    float height  = texelFetch(hc_heights, sample_, 0).r - (gl_VertexID < INNER ? 0.0 : a_block.z);
    v_place       = vec3((vec2(sample_) + hc_zero) / hc_steps, height);
    v_from_eye    = (v_place - u_place) / u_scale;
    float w       = u_orthographic ? 1.0 : dot(v_from_eye, u_forward);
    vec2  at      = vec2(dot(v_from_eye, u_right) / dot(u_right, u_right),
                         dot(v_from_eye, u_down) / dot(u_down, u_down));
    /* Depth is the fragment's. */
    gl_Position = vec4(at * u_window.xy + w * u_window.zw, 0.0, w);
}
