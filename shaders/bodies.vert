/* Triangles among terrain: to where terrain.frag's rays would meet them. */
uniform vec3  u_forward, u_right, u_down, u_anchor;
uniform bool  u_orthographic;
uniform vec4  u_window; /* of the picture, what is drawn now: scale, then shift */

layout(location = 0) in vec3 a_place; /* from the anchor, in the world */
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec3 a_colour;

out vec3 v_from_eye, v_normal, v_colour;

void main(void)
{
    v_from_eye = a_place - u_anchor;
    v_normal   = a_normal;
    v_colour   = a_colour;
    float w    = u_orthographic ? 1.0 : dot(v_from_eye, u_forward);
    vec2  at   = vec2(dot(v_from_eye, u_right) / dot(u_right, u_right),
                      dot(v_from_eye, u_down) / dot(u_down, u_down));
    /* Depth is the fragment's. */
    gl_Position = vec4(at * u_window.xy + w * u_window.zw, 0.0, w);
}
