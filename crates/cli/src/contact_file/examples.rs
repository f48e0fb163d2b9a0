//! What a contact file may say, for messages, in any dimension: a ball with its centre at 1 on the last axis falls onto a fixed body.

/// The vector `x` along the last axis.
pub(super) fn vector(n: usize, x: &str) -> String {
    format!("[{}{x}]", "0, ".repeat(n - 1))
}

/// The matrix with `x` on its diagonal.
fn diagonal(n: usize, x: &str) -> String {
    let row = |i: usize| (0..n).map(|j| if i == j { x } else { "0" }).collect::<Vec<_>>().join(", ");
    format!("[{}]", (0..n).map(|i| format!("[{}]", row(i))).collect::<Vec<_>>().join(", "))
}

/// The inertia of the ball.
pub(super) fn inertia(n: usize) -> String {
    match n {
        2 => "inertia = \"1/2\"".into(),
        3 => format!("inertia = {}", diagonal(n, "1")),
        _ => format!("S = {}", diagonal(n, "1")),
    }
}

/// Both bodies.
pub(super) fn bodies(n: usize) -> String {
    format!("[{{ mass = 1, position = {}, {} }}, {{ mass = \"inf\" }}]", vector(n, "1"), inertia(n))
}

/// No spin.
pub(super) fn no_spin(n: usize) -> String {
    match n {
        2 => "0".into(),
        3 => vector(n, "0"),
        _ => diagonal(n, "0"),
    }
}

/// A velocity of `x` along the last axis.
pub(super) fn motion(n: usize, x: &str) -> String {
    format!("{{ v = {}, w = {} }}", vector(n, x), no_spin(n))
}

/// All of it.
pub(super) fn file(n: usize) -> String {
    let [point, normal, bodies] = [vector(n, "0"), vector(n, "1"), bodies(n)];
    let [first, second] = ["-1", "0"].map(|x| motion(n, x));
    format!(
        "{{ dim = {n}, law = \"no-slip\", bodies = {bodies}, contact_point = {point}, normal = {normal}, pre = [{first}, {second}] }}"
    )
}
