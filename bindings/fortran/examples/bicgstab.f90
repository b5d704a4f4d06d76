! BiCGStab (van der Vorst 1992) with the diagonal as its preconditioner, for matrices that are not symmetric.
module bicgstab
  use, intrinsic :: iso_fortran_env, only: real64
  use sparse_matrix, only: matrix, multiply
  implicit none
  private
  public :: solve

contains

  ! Solves a x = b from the x that is given, until the residual is below tolerance times b's length. iterations < 0: it
  ! did not get there.
  subroutine solve(a, b, tolerance, x, iterations)
    type(matrix), intent(in) :: a
    real(real64), intent(in) :: b(:), tolerance
    real(real64), intent(inout) :: x(:)
    integer, intent(out) :: iterations
    integer, parameter :: most = 1000
    real(real64), dimension(size(x)) :: r, shadow, p, v, s, t, y, weight
    real(real64) :: rho, rho_before, alpha, omega, enough
    integer :: i
    weight = 1 / diagonal(a, size(x))
    call multiply(a, x, v)
    r = b - v
    shadow = r
    p = r
    rho = dot_product(shadow, r)
    enough = tolerance * norm2(b)
    do iterations = 0, most
      if (norm2(r) <= enough) return
      y = weight * p
      call multiply(a, y, v)
      alpha = rho / dot_product(shadow, v)
      s = r - alpha * v
      x = x + alpha * y
      y = weight * s
      call multiply(a, y, t)
      omega = dot_product(t, s) / dot_product(t, t)
      rho_before = rho
      do i = 1, size(x)
        x(i) = x(i) + omega * y(i)
        r(i) = s(i) - omega * t(i)
      end do
      rho = dot_product(shadow, r)
      p = r + rho / rho_before * alpha / omega * (p - omega * v)
    end do
    iterations = -1
  end subroutine

  pure function diagonal(a, n) result(d)
    type(matrix), intent(in) :: a
    integer, intent(in) :: n
    real(real64) :: d(n)
    integer :: row, k
    do row = 1, n
      do k = a%first(row), a%first(row + 1) - 1
        if (a%column(k) == row) d(row) = a%value(k)
      end do
    end do
  end function
end module
