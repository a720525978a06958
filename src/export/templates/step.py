@HEAD@
# State z: @STATES@.
# Inputs u: @INPUTS@; held during a step.

import math

N, M = @N@, @M@
# Measured values, inputs that are commanded, and what of a motion these decide.
K, COMMANDED, T = @K@, @COMMANDED@, @T@

# Fitted parameters and their covariance.
PARAMETER_NAMES = @NAMES@
COVARIANCE = @COVARIANCE@


def creepage_sign(x):
    return (x > 0.0) - (x < 0.0)


def creepage_heaviside(x):
    return 1.0 if x > 0.0 else 0.0


def rates(z, u):
    """dz/dt, and its derivatives by (z, u)."""
    rate = [0.0]*N
    by = [[0.0]*(N + M) for _ in range(N)]
@READ@@VALUES@@RATES@@SLOPES@    return rate, by


def step(z, u, dt):
    """The state after dt by one Runge-Kutta step of order four, and d(new z)/d(z, u)."""
    rate, total = [0.0]*N, [0.0]*N
    slope, whole = [[0.0]*(N + M) for _ in range(N)], [[0.0]*(N + M) for _ in range(N)]
    for ahead, weight in ((0.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 1.0)):
        at = [z[i] + ahead*dt*rate[i] for i in range(N)]
        w = [[float(i == j) + ahead*dt*slope[i][j] for j in range(N + M)] for i in range(N)]
        rate, by = rates(at, u)
        slope = [[sum(by[i][l]*w[l][j] for l in range(N)) + (by[i][j] if j >= N else 0.0) for j in range(N + M)]
                 for i in range(N)]
        total = [total[i] + weight/6.0*rate[i] for i in range(N)]
        whole = [[whole[i][j] + weight/6.0*slope[i][j] for j in range(N + M)] for i in range(N)]
    jacobian = [[float(i == j) + dt*whole[i][j] for j in range(N + M)] for i in range(N)]
    return [z[i] + dt*total[i] for i in range(N)], jacobian


# Variances: what each state wanders beside the model in a second, and of each measured value.
WALK = @WALK@
NOISE = @NOISE@


def measured(z):
    """What the sensor measures (x, y, then angles), and its derivatives by z."""
    y = [0.0]*K
    by = [[0.0]*N for _ in range(K)]
@READ_MEASURED@@VALUES_MEASURED@@MEASURED@@SLOPES_MEASURED@    return y, by


def observer(state, covariance, inputs, measurement, dt):
    """State and covariance after one step of an extended Kalman filter: ahead by dt under held inputs, then a measurement, whose
    values come one after another; angles are compared without whole turns, and a value that is no number is not taken in."""
    predicted, f = step(state, inputs, dt)
    moved = [[sum(f[i][k]*covariance[k][j] for k in range(N)) for j in range(N)] for i in range(N)]
    p = [[sum(moved[i][k]*f[j][k] for k in range(N)) + (WALK[i]*dt if i == j else 0.0) for j in range(N)] for i in range(N)]
    y, h = measured(predicted)
    z = list(predicted)
    for m in range(K):
        off = measurement[m] - y[m]
        if math.isnan(off):
            continue
        if m > 1:
            off -= 2.0*math.pi*math.floor(off/(2.0*math.pi) + 0.5)
        off -= sum(h[m][i]*(z[i] - predicted[i]) for i in range(N))
        column = [sum(p[i][j]*h[m][j] for j in range(N)) for i in range(N)]
        expected = NOISE[m] + sum(h[m][i]*column[i] for i in range(N))
        gain = [c/expected for c in column]
        z = [z[i] + gain[i]*off for i in range(N)]
        p = [[p[i][j] - gain[i]*column[j] for j in range(N)] for i in range(N)]
    return z, p


def off_motion(twist, z, u):
    """How far inputs and hidden states are from a wanted motion of the reference point, hidden states at rest; with derivatives."""
    rate, by = rates(z, u)
    c, s = math.cos(z[2]), math.sin(z[2])
    at = [N + j for j in range(COMMANDED)] + list(range(K, N))
    off, slope = [], []
    for i in range(T + N - K):
        if i >= T or (i == T - 1 and T > 1):
            row = 2 if i < T else K + i - T
            value, slopes = rate[row], by[row]
        else:
            x, y = (c, s) if i == 0 else (-s, c)
            value, slopes = x*rate[0] + y*rate[1], [x*a + y*b for a, b in zip(by[0], by[1])]
        off.append(value - (twist[i] if i < T else 0.0))
        slope.append([slopes[j] for j in at])
    return off, slope


def inverse(twist, state, inputs):
    """Inputs under which the reference point comes to move as wanted (@TWIST@; m/s and rad/s), hidden states at rest, by the
    method of Levenberg and Marquardt from the inputs that are given; None where none are found."""
    z, u, damping = list(state), list(inputs), 1e-6
    size = COMMANDED + N - K
    for _ in range(200):
        off, slope = off_motion(twist, z, u)
        here = sum(v*v for v in off)
        if here < 1e-18:
            return u
        a = [[sum(row[i]*(row[j] if j < size else -v) for row, v in zip(slope, off)) for j in range(size + 1)]
             for i in range(size)]
        for i in range(size):
            a[i][i] += damping*(a[i][i] + 1e-6)
        for i in range(size):
            for r in range(size):
                factor = 0.0 if r == i else a[r][i]/a[i][i]
                for j in range(i, size + 1):
                    a[r][j] -= factor*a[i][j]
        move = [a[i][size]/a[i][i] for i in range(size)]
        other_z = z[:K] + [v + d for v, d in zip(z[K:], move[COMMANDED:])]
        other_u = [v + d for v, d in zip(u, move[:COMMANDED])] + u[COMMANDED:]
        if sum(v*v for v in off_motion(twist, other_z, other_u)[0]) < here:
            z, u, damping = other_z, other_u, max(0.1*damping, 1e-13)
        else:
            damping *= 10.0
    return None
