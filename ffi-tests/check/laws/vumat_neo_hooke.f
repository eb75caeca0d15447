C     Neo-Hooke, compressible, for Abaqus/Explicit: on axes that turn with
C     R of F = R U, where b is U U.
C
C       W = mu/2 (tr bbar - 3) + kappa/2 (J - 1)**2, bbar = J**(-2/3) b
C       J sigma = mu dev bbar + kappa J (J - 1) I
C
C     PROPS   1 shear modulus mu, 2 bulk modulus kappa, 3 the stretch
C             (the root of tr b / 3) beyond which a point is deleted
C     STATE   1 alive: 1, or 0 of a point that is deleted
C     ENERGY  W over the undeformed density: per mass
      SUBROUTINE VUMAT(NBLOCK,NDIR,NSHR,NSTATEV,NFIELDV,NPROPS,LANNEAL,
     1 STEPTIME,TOTALTIME,DT,CMNAME,COORDMP,CHARLENGTH,PROPS,DENSITY,
     2 STRAININC,RELSPININC,TEMPOLD,STRETCHOLD,DEFGRADOLD,FIELDOLD,
     3 STRESSOLD,STATEOLD,ENERINTERNOLD,ENERINELASOLD,TEMPNEW,
     4 STRETCHNEW,DEFGRADNEW,FIELDNEW,STRESSNEW,STATENEW,
     5 ENERINTERNNEW,ENERINELASNEW)
      INCLUDE 'VABA_PARAM.INC'
      CHARACTER*80 CMNAME
      DIMENSION PROPS(NPROPS),DENSITY(NBLOCK),COORDMP(NBLOCK,*),
     1 CHARLENGTH(NBLOCK),STRAININC(NBLOCK,NDIR+NSHR),
     2 RELSPININC(NBLOCK,NSHR),TEMPOLD(NBLOCK),TEMPNEW(NBLOCK),
     3 STRETCHOLD(NBLOCK,NDIR+NSHR),STRETCHNEW(NBLOCK,NDIR+NSHR),
     4 DEFGRADOLD(NBLOCK,NDIR+NSHR+NSHR),
     5 DEFGRADNEW(NBLOCK,NDIR+NSHR+NSHR),FIELDOLD(NBLOCK,NFIELDV),
     6 FIELDNEW(NBLOCK,NFIELDV),STRESSOLD(NBLOCK,NDIR+NSHR),
     7 STRESSNEW(NBLOCK,NDIR+NSHR),STATEOLD(NBLOCK,NSTATEV),
     8 STATENEW(NBLOCK,NSTATEV),ENERINTERNOLD(NBLOCK),
     9 ENERINTERNNEW(NBLOCK),ENERINELASOLD(NBLOCK),
     1 ENERINELASNEW(NBLOCK)
      DIMENSION U(6), V(6), B(6)
      XMU = PROPS(1)
      XKAPPA = PROPS(2)
      XLIMIT = PROPS(3)
      TWO = 2
C
      DO 100 I = 1, NBLOCK
        ENERINELASNEW(I) = ENERINELASOLD(I)
C       The data check: a linear elastic answer to the strain.
        IF (STEPTIME .EQ. 0. .AND. TOTALTIME .EQ. 0.) THEN
          TRACE = STRAININC(I,1) + STRAININC(I,2) + STRAININC(I,3)
          DO 10 K = 1, NDIR + NSHR
            STRESSNEW(I,K) = STRESSOLD(I,K) + 2*XMU*STRAININC(I,K)
            IF (K .LE. NDIR) STRESSNEW(I,K) = STRESSNEW(I,K)
     1                     + (XKAPPA - 2*XMU/3)*TRACE
   10     CONTINUE
          STATENEW(I,1) = STATEOLD(I,1)
          ENERINTERNNEW(I) = ENERINTERNOLD(I)
          GO TO 100
        END IF
C
C       11 22 33 12 23 31; V is U at the middle of the increment.
        DO 20 K = 1, 6
          U(K) = 0
          V(K) = 0
          IF (K .LE. NDIR + NSHR) THEN
            U(K) = STRETCHNEW(I,K)
            V(K) = (STRETCHNEW(I,K) + STRETCHOLD(I,K))/2
          END IF
   20   CONTINUE
        DET = U(1)*(U(2)*U(3) - U(5)*U(5)) - U(4)*(U(4)*U(3)
     1      - U(5)*U(6)) + U(6)*(U(4)*U(5) - U(2)*U(6))
        DETV = V(1)*(V(2)*V(3) - V(5)*V(5)) - V(4)*(V(4)*V(3)
     1       - V(5)*V(6)) + V(6)*(V(4)*V(5) - V(2)*V(6))
        B(1) = U(1)*U(1) + U(4)*U(4) + U(6)*U(6)
        B(2) = U(4)*U(4) + U(2)*U(2) + U(5)*U(5)
        B(3) = U(6)*U(6) + U(5)*U(5) + U(3)*U(3)
        B(4) = U(1)*U(4) + U(4)*U(2) + U(6)*U(5)
        B(5) = U(4)*U(6) + U(2)*U(5) + U(5)*U(3)
        B(6) = U(6)*U(1) + U(5)*U(4) + U(3)*U(6)
        TRB = B(1) + B(2) + B(3)
        ALIVE = STATEOLD(I,1)
        IF (TRB .GT. 3*XLIMIT**2) ALIVE = 0
        STATENEW(I,1) = ALIVE
        IF (ALIVE .EQ. 0.) THEN
          DO 30 K = 1, NDIR + NSHR
            STRESSNEW(I,K) = 0
   30     CONTINUE
          ENERINTERNNEW(I) = ENERINTERNOLD(I)
          GO TO 100
        END IF
C
        SCALE = DET**(-TWO/3)
        DO 40 K = 1, NDIR + NSHR
          STRESSNEW(I,K) = XMU*SCALE/DET*B(K)
          IF (K .LE. NDIR) STRESSNEW(I,K) = XMU*SCALE/DET
     1                   *(B(K) - TRB/3) + XKAPPA*(DET - 1)
   40   CONTINUE
        ENERGY = XMU/2*(SCALE*TRB - 3) + XKAPPA/2*(DET - 1)**2
        ENERINTERNNEW(I) = ENERGY/(DENSITY(I)*DETV)
  100 CONTINUE
      RETURN
      END
