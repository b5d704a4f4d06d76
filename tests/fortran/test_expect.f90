! What tests of the module tetlod count as failures.
module test_expect
  implicit none
  public
  integer :: failures = 0

contains

  subroutine expect(holds, what)
    logical, intent(in) :: holds
    character(len=*), intent(in) :: what
    if (holds) return
    failures = failures + 1
    print '("failed: ", a)', what
  end subroutine
end module
