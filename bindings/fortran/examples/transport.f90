! Unsteady advection and diffusion of a concentration in a closed box, on tets with linear elements:
!     dc/dt + a . grad c = kappa laplace c,   no flux through the walls.
! In space streamline upwind Petrov-Galerkin (Brooks and Hughes 1982) with discontinuity capturing (Bazilevs, Calo,
! Tezduyar, Hughes 2007), so that the front neither smears nor rings; in time Crank-Nicolson. The capturing depends on
! the solution, which is why a step is a few linear systems.
module transport
  use, intrinsic :: iso_fortran_env, only: int32, int64, real64
  use bicgstab, only: solve
  use sparse_matrix, only: make_pattern, matrix
  implicit none
  private
  public :: begin_transport, advance, bytes_of

  real(real64), parameter :: pi = acos(-1d0), tolerance = 1d-8, settled = 1d-3

  type, public :: flow
    real(real64), allocatable :: xyz(:, :)            ! (3, n)
    integer(int32), allocatable :: tets(:, :)         ! (4, m), counted from 1
    real(real64), allocatable :: concentration(:)     ! (n)
    real(real64) :: time = 0, step = 0.02d0, diffusivity = 5d-4
    integer :: systems = 0, iterations = 0            ! of the last step
    real(real64), allocatable, private :: gradient(:, :, :)  ! (3, 4, m): of the four linear functions
    real(real64), allocatable, private :: volume(:), velocity(:, :), right(:)
    type(matrix), private :: left
  end type

contains

  ! A ball of concentration 1 in the box, off its middle, which the flow draws out to a sheet.
  subroutine begin_transport(xyz, tets, f)
    real(real64), intent(in) :: xyz(:, :)
    integer(int32), intent(in) :: tets(:, :)
    type(flow), intent(out) :: f
    integer :: v, t
    f%xyz = xyz
    f%tets = tets
    allocate (f%concentration(size(xyz, 2)), f%right(size(xyz, 2)), f%velocity(3, size(xyz, 2)))
    do v = 1, size(xyz, 2)
      f%concentration(v) = 0.5d0 * (1 - tanh((norm2(xyz(:, v) - [0.3d0, 0.4d0, 0.35d0]) - 0.2d0) / 0.03d0))
    end do
    allocate (f%gradient(3, 4, size(tets, 2)), f%volume(size(tets, 2)))
    do t = 1, size(tets, 2)
      call measure(xyz(:, tets(:, t)), f%gradient(:, :, t), f%volume(t))
    end do
    call make_pattern(size(xyz, 2), tets, f%left)
  end subroutine

  pure subroutine measure(corners, gradient, volume)
    real(real64), intent(in) :: corners(3, 4)
    real(real64), intent(out) :: gradient(3, 4), volume
    real(real64) :: e(3, 3), determinant
    integer :: k
    do k = 1, 3
      e(:, k) = corners(:, k + 1) - corners(:, 1)
    end do
    determinant = dot_product(e(:, 1), cross(e(:, 2), e(:, 3)))
    gradient(:, 2) = cross(e(:, 2), e(:, 3)) / determinant
    gradient(:, 3) = cross(e(:, 3), e(:, 1)) / determinant
    gradient(:, 4) = cross(e(:, 1), e(:, 2)) / determinant
    gradient(:, 1) = -gradient(:, 2) - gradient(:, 3) - gradient(:, 4)
    volume = determinant / 6
  end subroutine

  pure function cross(a, b) result(c)
    real(real64), intent(in) :: a(3), b(3)
    real(real64) :: c(3)
    c = [a(2) * b(3) - a(3) * b(2), a(3) * b(1) - a(1) * b(3), a(1) * b(2) - a(2) * b(1)]
  end function

  ! Along the walls, without sources, and turning with time.
  pure function velocity_at(p, time) result(a)
    real(real64), intent(in) :: p(3), time
    real(real64) :: a(3), s(3), c(3)
    s = sin(pi * p)
    c = cos(pi * p)
    a = [s(1) * c(2) * c(3), c(1) * s(2) * c(3), c(1) * c(2) * s(3)] * cos(2 * pi * ([0, 1, 2] / 3d0 + time / 4))
  end function

  ! One step of time. error stop where the solver does not converge.
  subroutine advance(f)
    type(flow), intent(inout) :: f
    integer, parameter :: most = 50
    real(real64) :: old(size(f%concentration)), before(size(f%concentration))
    integer :: v, system, iterations
    do v = 1, size(f%velocity, 2)
      f%velocity(:, v) = velocity_at(f%xyz(:, v), f%time + f%step / 2)
    end do
    old = f%concentration
    f%iterations = 0
    do system = 1, most
      before = f%concentration
      call assemble(f, old)
      call solve(f%left, f%right, tolerance, f%concentration, iterations)
      if (iterations < 0) error stop "transport: BiCGStab does not converge"
      f%iterations = f%iterations + iterations
      if (maxval(abs(f%concentration - before)) < settled) exit
    end do
    if (system > most) error stop "transport: the capturing does not settle"
    f%systems = system
    f%time = f%time + f%step
  end subroutine

  ! The linear system of a step from `old`, where capturing knows the concentration as the last system gave it.
  subroutine assemble(f, old)
    type(flow), intent(inout) :: f
    real(real64), intent(in) :: old(:)
    real(real64) :: mass(4, 4), change(4, 4), along(3), kappa, was(4)
    integer :: t, i, j
    f%left%value = 0
    f%right = 0
    do t = 1, size(f%tets, 2)
      along = sum(f%velocity(:, f%tets(:, t)), 2) / 4
      was = old(f%tets(:, t))
      kappa = f%diffusivity + captured(f%gradient(:, :, t), along, was, f%concentration(f%tets(:, t)), f%step)
      call element(f%gradient(:, :, t), f%volume(t), along, kappa, f%step, mass, change)
      do j = 1, 4
        do i = 1, 4
          associate (place => f%left%place(i, j, t), vertex => f%tets(i, t))
            f%left%value(place) = f%left%value(place) + mass(i, j) + change(i, j)
            f%right(vertex) = f%right(vertex) + (mass(i, j) - change(i, j)) * was(j)
          end associate
        end do
      end do
    end do
  end subroutine

  ! What is added to the diffusivity where transport is out of balance: |dc/dt + a . grad c| h / (2 |grad c|), h the
  ! length of the tet along the gradient.
  pure real(real64) function captured(gradient, a, old, new, step)
    real(real64), intent(in) :: gradient(3, 4), a(3), old(4), new(4), step
    real(real64) :: slope(3), across
    slope = matmul(gradient, old + new) / 2
    across = sum(abs(matmul(slope, gradient)))
    captured = 0
    if (across > 1d-6) captured = abs(sum(new - old) / (4 * step) + dot_product(a, slope)) / across
  end function

  ! mass: of the concentration, change: half a step's transport, both tested by the linear functions with their slope
  ! along the stream.
  pure subroutine element(gradient, volume, a, kappa, step, mass, change)
    real(real64), intent(in) :: gradient(3, 4), volume, a(3), kappa, step
    real(real64), intent(out) :: mass(4, 4), change(4, 4)
    real(real64) :: along(4), tau, upwind
    integer :: i, j
    along = matmul(a, gradient)
    tau = 1 / sqrt((2 / step)**2 + sum(abs(along))**2 + (4 * kappa * sum(gradient**2))**2)
    do j = 1, 4
      do i = 1, 4
        upwind = 0.25d0 + tau * along(i)
        mass(i, j) = volume * (merge(0.1d0, 0.05d0, i == j) + tau * along(i) / 4)
        change(i, j) = step / 2 * volume * (upwind * along(j) + kappa * dot_product(gradient(:, i), gradient(:, j)))
      end do
    end do
  end subroutine

  ! Of the solver's arrays.
  pure integer(int64) function bytes_of(f) result(bytes)
    type(flow), intent(in) :: f
    bytes = 8_int64 * (size(f%xyz) + size(f%concentration) + size(f%gradient) + size(f%volume) + size(f%velocity) + &
      size(f%right) + size(f%left%value)) + 4_int64 * (size(f%tets) + size(f%left%first) + size(f%left%column) + &
      size(f%left%place))
  end function
end module
