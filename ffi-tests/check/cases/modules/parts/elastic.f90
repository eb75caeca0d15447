module elastic
  use precision, only: real_kind
  implicit none
contains
  pure function stiffness(modulus, ratio, n) result(c)
    real(real_kind), intent(in) :: modulus, ratio
    integer, intent(in) :: n
    real(real_kind) :: c(n, n), shear
    integer :: i
    shear = modulus/(2*(1 + ratio))
    c = 0
    c(1:3, 1:3) = modulus*ratio/((1 + ratio)*(1 - 2*ratio))
    do i = 1, n
      c(i, i) = c(i, i) + shear*merge(2, 1, i <= 3)
    end do
  end function stiffness
end module elastic
