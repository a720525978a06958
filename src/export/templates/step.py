@HEAD@
# State z: @STATES@.
# Inputs u: @INPUTS@; held during a step.

import math

N, M = @N@, @M@

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
